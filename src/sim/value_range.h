#pragma once

#include <cstdint>
#include <optional>
#include <span>

namespace gelatin {

/// The value, above the least, that 99 of 100 do not pass: the upper end of its bin in a histogram by the
/// upper bits of floats (gpu::TetValues). 0 where nothing is counted.
float high_value(std::span<const std::uint32_t> histogram);

/// Where a scale of colours ends that follows what it shows and yet stays calm: at 1, 1.5, 2, 3, 5 or 7 times
/// a power of ten. It grows at once, and gets smaller only when values have been low for two seconds of
/// pictures.
class CalmRange {
public:
    /// @param least the smallest that it may be, > 0: what is less is noise
    explicit CalmRange(float least);

    /// Takes the next picture's high value. @return the end
    float follow(float high);

private:
    float least_;
    std::optional<float> end_;
    float highest_since_ = 0.0f;  // of the pictures in which a smaller one would have done
    int low_pictures_ = 0;
};

}  // namespace gelatin
