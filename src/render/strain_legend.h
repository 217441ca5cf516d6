#pragma once

#include <array>
#include <glm/vec3.hpp>

#include "gl/program.h"
#include "render/frame.h"
#include "render/target.h"

namespace gelatin::render {

/// Colours of strain from fully compressed over none to fully stretched, sRGB values: blue, light, orange,
/// which people with the common kinds of colour blindness tell apart.
const std::array<glm::vec3, 5>& strain_colors();

/// What the colours of strain mean: a bar of them with the strains at its ends, in the lower left corner.
class StrainLegend {
public:
    explicit StrainLegend(float full_strain);

    float full_strain() const { return full_strain_; }
    /// @pre a vertex array object is bound, faces are not culled
    void draw(const View& view) const;

private:
    float full_strain_;
    gl::Program program_;
    Target picture_;
};

}  // namespace gelatin::render
