#pragma once

#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

namespace gelatin {

/// A line that is drawn over bodies, as OverlayView::lines has it.
struct OverlayLine {
    // As in shaders/render/marked_lines.vert. A point is a line without length.
    static constexpr float kAttached = 0.0f, kBetween = 1.0f, kAxis = 2.0f, kBone = 3.0f, kCarried = 4.0f;

    glm::vec4 from;  ///< xyz [m], what it is
    glm::vec4 to;    ///< xyz [m], 0
};

inline OverlayLine line_of(float kind, const glm::dvec3& from, const glm::dvec3& to) {
    return {glm::vec4(from, kind), glm::vec4(to, 0.0f)};
}

}  // namespace gelatin
