#include "sim/value_range.h"

#include <gtest/gtest.h>

#include <bit>
#include <limits>
#include <vector>

#include "gpu/view/tet_values.h"

namespace gelatin {
namespace {

using gpu::TetValues;

std::vector<std::uint32_t> histogram_of(const std::vector<float>& values) {
    std::vector<std::uint32_t> histogram(TetValues::kBins);
    for (const float value : values) ++histogram[std::bit_cast<std::uint32_t>(value) >> TetValues::kBinShift];
    return histogram;
}

TEST(HighValue, IsWhatOneInAHundredPasses) {
    std::vector<float> values;
    for (int i = 1; i <= 1000; ++i) values.push_back(0.01f * static_cast<float>(i));
    const float high = high_value(histogram_of(values));
    EXPECT_GE(high, 9.9f);
    EXPECT_LE(high, 9.9f * 1.08f) << "a bin is a sixteenth wide at most";
    values.push_back(1e20f);
    EXPECT_LE(high_value(histogram_of(values)), 9.9f * 1.08f) << "one tet does not decide";
}

TEST(HighValue, IsZeroAtRestAndFiniteWhateverHappens) {
    EXPECT_EQ(high_value(histogram_of(std::vector<float>(50, 0.0f))), 0.0f);
    EXPECT_EQ(high_value(histogram_of({})), 0.0f);
    EXPECT_GT(high_value(histogram_of({std::numeric_limits<float>::quiet_NaN()})), 1e30f);
    EXPECT_GT(CalmRange(1.0f).follow(std::numeric_limits<float>::infinity()), 1e29f);
    EXPECT_LT(CalmRange(1.0f).follow(std::numeric_limits<float>::infinity()), 1e32f);
}

TEST(CalmRange, HasRoundEndsThatHoldWhatTheyAreAskedTo) {
    for (const auto& [high, end] :
         {std::pair(0.9f, 1.0f), std::pair(1.1f, 1.5f), std::pair(1.6f, 2.0f), std::pair(2.5f, 3.0f),
          std::pair(4.0f, 5.0f), std::pair(650.0f, 700.0f), std::pair(8e4f, 1e5f), std::pair(0.012f, 0.015f)})
        EXPECT_FLOAT_EQ(CalmRange(1e-3f).follow(high), end) << high;
    EXPECT_FLOAT_EQ(CalmRange(0.5f).follow(0.0f), 0.5f) << "noise is not blown up";
}

TEST(CalmRange, GrowsAtOnceAndShrinksLate) {
    CalmRange range(1e-3f);
    EXPECT_EQ(range.follow(4.0f), 5.0f);
    EXPECT_EQ(range.follow(60.0f), 70.0f);
    for (int i = 0; i < 119; ++i) EXPECT_EQ(range.follow(i == 50 ? 16.0f : 4.0f), 70.0f) << i;
    EXPECT_EQ(range.follow(4.0f), 20.0f) << "what was the most meanwhile still fits";
    for (int i = 0; i < 119; ++i) EXPECT_EQ(range.follow(4.0f), 20.0f);
    EXPECT_EQ(range.follow(4.0f), 5.0f);
    for (int i = 0; i < 500; ++i) EXPECT_EQ(range.follow(i % 100 == 0 ? 4.5f : 0.1f), 5.0f) << i;
}

}  // namespace
}  // namespace gelatin
