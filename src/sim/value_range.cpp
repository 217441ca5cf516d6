#include "sim/value_range.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <numeric>

#include "gpu/view/tet_values.h"

namespace gelatin {
namespace {

constexpr int kPatience = 120;  // pictures
constexpr std::size_t kInfinity = std::bit_cast<std::uint32_t>(std::numeric_limits<float>::infinity()) >>
                                  gpu::TetValues::kBinShift;  // the first bin that is no number

// The smallest number that is not less, of 1, 1.5, 2, 3, 5 and 7 times a power of ten.
float round_up(float value) {
    const float power = std::pow(10.0f, std::floor(std::log10(value)));
    for (const float factor : {1.0f, 1.5f, 2.0f, 3.0f, 5.0f, 7.0f}) {
        if (factor * power >= value) return factor * power;
    }
    return 10.0f * power;
}

}  // namespace

float high_value(std::span<const std::uint32_t> histogram) {
    const std::uint64_t all = std::accumulate(histogram.begin(), histogram.end(), std::uint64_t{0});
    std::uint64_t above = 0;
    for (std::size_t bin = histogram.size(); bin-- > 1;) {  // the first bin contains zeros
        above += histogram[bin];
        if (100 * above <= all) continue;
        const auto end = static_cast<std::uint32_t>(std::min(bin + 1, kInfinity));
        return std::bit_cast<float>(end << gpu::TetValues::kBinShift);
    }
    return 0.0f;
}

CalmRange::CalmRange(float least) : least_(least) {}

float CalmRange::follow(float high) {
    const float needed = round_up(std::clamp(high, least_, 1e30f));
    if (!end_ || needed >= *end_) {
        end_ = needed;
        low_pictures_ = 0;
        highest_since_ = 0.0f;
        return *end_;
    }
    highest_since_ = std::max(highest_since_, needed);
    if (++low_pictures_ >= kPatience) {
        end_ = highest_since_;
        low_pictures_ = 0;
        highest_since_ = 0.0f;
    }
    return *end_;
}

}  // namespace gelatin
