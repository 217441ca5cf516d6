#pragma once

#include <cstdint>
#include <optional>
#include <span>

namespace gelatin {

/// The value, above the smallest, that 99 of 100 do not exceed: the upper end of its bin in a histogram by
/// the upper bits of floats (gpu::TetValues). 0 if nothing is counted.
float high_value(std::span<const std::uint32_t> histogram);

/// The end of a scale of colours that adapts to the values without flicker: 1, 1.5, 2, 3, 5 or 7 times a
/// power of ten. It grows at once, and shrinks only when values have been low for two seconds of pictures.
class CalmRange {
public:
    /// @param least the smallest end, > 0: lower values are noise
    explicit CalmRange(float least);

    /// Adds the next picture's high value. @return the end
    float follow(float high);

private:
    float least_;
    std::optional<float> end_;
    float highest_since_ = 0.0f;  // number of pictures for which a smaller one would have been enough
    int low_pictures_ = 0;
};

}  // namespace gelatin
