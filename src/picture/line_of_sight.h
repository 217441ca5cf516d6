#pragma once

#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "render/camera.h"

namespace gelatin {

/// Whether colliders hide bodies from a camera, at one time. A surface hides only what is behind its front,
/// as it is not drawn from behind.
class LineOfSight {
public:
    /// @param bodies points of them, of which some are checked
    explicit LineOfSight(std::span<const glm::vec3> bodies);
    void add_surface(std::vector<glm::vec3> corners);  ///< three for each face

    /// The fraction of the points that can be seen from `eye`; 1 if there are none.
    float seen_from(const glm::vec3& eye) const;

private:
    struct Surface {
        std::vector<glm::vec3> corners;  // three for each face
        render::Bounds bounds;
    };
    bool is_hidden(const glm::vec3& from, const glm::vec3& eye) const;

    std::vector<glm::vec3> targets_;
    std::vector<Surface> surfaces_;
};

}  // namespace gelatin
