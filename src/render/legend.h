#pragma once

#include <array>
#include <glm/vec3.hpp>
#include <span>
#include <string>
#include <vector>

#include "gelatin/views.h"
#include "gl/program.h"
#include "render/frame.h"
#include "render/target.h"

namespace gelatin::render {

/// Colours that stand for numbers: sRGB values, evenly spaced and interpolated, with what the bar of them
/// says.
struct ColorScale {
    std::span<const glm::vec3> colors;  ///< of something that outlives this
    std::string title;                  ///< may be empty
    std::string low, middle, high;      ///< at the bar's ends and in its middle
    bool operator==(const ColorScale& other) const {
        return title == other.title && low == other.low && middle == other.middle && high == other.high;
    }
};

/// Springs: from compressed over none to stretched, blue over light grey to orange.
const std::array<glm::vec3, 5>& strain_colors();
ColorScale strain_scale(float full_strain);

/// Quantities that have one end: from dark blue to yellow, ever lighter, as evenly for the colour-blind.
/// Points of "viridis" (van der Walt and Smith 2015).
const std::array<glm::vec3, 9>& value_colors();
ColorScale value_scale(const ColorMapView& map);

/// Sets what spring_lines.vert goes by, and shaders/render/include/color_map.glsl.
void set_strain_colors(const gl::Program& program, float full_strain);
void set_value_colors(const gl::Program& program, const ColorMapView& map);

/// What colours mean: a bar of them with numbers, in the lower left corner.
class Legend {
public:
    Legend();

    /// @param letter_size [pixels]
    void show(const ColorScale& scale, int letter_size);
    /// @pre something is shown; a vertex array object is bound, faces are not culled
    void draw(const View& view) const;

private:
    ColorScale scale_;
    int letter_size_ = 0;  // [pixels]
    gl::Program program_;
    Target picture_;
};

}  // namespace gelatin::render
