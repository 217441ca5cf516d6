#include "cpu/measure/watch_nodes.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <limits>

namespace gelatin {
namespace {

constexpr std::size_t kNodes = 9000;  // more than a task's, and no multiple of anything

// Nodes of 2 kg at 3 m/s: 9 J each.
template <class Real>
cpu::Nodes<Real> moving_nodes() {
    return {std::vector<cpu::Vec4<Real>>(kNodes, {1, 2, 3, 0.5}),
            std::vector<cpu::Vec4<Real>>(kNodes, {0, 3, 0, 0.01})};
}

template <class Real>
class WatchNodesTest : public ::testing::Test {};
using Precisions = ::testing::Types<float, double>;
TYPED_TEST_SUITE(WatchNodesTest, Precisions);

TYPED_TEST(WatchNodesTest, LetsSoundNodesPass) {
    auto nodes = moving_nodes<TypeParam>();
    nodes.positions[70] = {0, 0, 0, 0};  // pinned, and moved by somebody
    nodes.velocities[70] = {1e10, 0, 0, 0};
    Alarm alarm = kNoAlarm;
    cpu::watch_nodes<TypeParam>(nodes, 1, TypeParam(9.001), alarm);
    cpu::watch_nodes<TypeParam>(nodes, 2, std::numeric_limits<TypeParam>::infinity(), alarm);
    EXPECT_EQ(alarm.count, 0u);
}

TYPED_TEST(WatchNodesTest, NamesTheLeastOfTheFastAndTheFastestSpeed) {
    auto nodes = moving_nodes<TypeParam>();
    nodes.velocities[8000].z = 4;
    nodes.velocities[123].x = 0.5;
    Alarm alarm = kNoAlarm;
    cpu::watch_nodes<TypeParam>(nodes, 7, TypeParam(9.001), alarm);
    EXPECT_EQ(alarm.step, 7u);
    EXPECT_EQ(alarm.node, 123u);
    EXPECT_EQ(alarm.count, 2u);
    EXPECT_FLOAT_EQ(std::bit_cast<float>(alarm.speed), 5.0f);
}

TYPED_TEST(WatchNodesTest, FindsWhateverIsNotFinite) {
    for (const TypeParam bad :
         {std::numeric_limits<TypeParam>::quiet_NaN(), std::numeric_limits<TypeParam>::infinity()}) {
        for (int k = 0; k < 6; ++k) {
            auto nodes = moving_nodes<TypeParam>();
            (k < 3 ? nodes.positions : nodes.velocities)[kNodes - 1][k % 3] = bad;
            Alarm alarm = kNoAlarm;
            cpu::watch_nodes<TypeParam>(nodes, 1, TypeParam(1e6), alarm);
            EXPECT_EQ(alarm.node, kNodes - 1) << k;
            EXPECT_EQ(alarm.count, 1u);
            EXPECT_TRUE(std::isnan(std::bit_cast<float>(alarm.speed)));
        }
    }
}

TYPED_TEST(WatchNodesTest, KeepsTheFirstStep) {
    auto nodes = moving_nodes<TypeParam>();
    Alarm alarm = kNoAlarm;
    cpu::watch_nodes<TypeParam>(nodes, 1, TypeParam(10), alarm);
    nodes.velocities[50].x = 10;
    cpu::watch_nodes<TypeParam>(nodes, 2, TypeParam(10), alarm);
    nodes.velocities[3].x = 100;
    cpu::watch_nodes<TypeParam>(nodes, 3, TypeParam(10), alarm);
    EXPECT_EQ(alarm.step, 2u);
    EXPECT_EQ(alarm.node, 50u);
    EXPECT_EQ(alarm.count, 1u);
}

}  // namespace
}  // namespace gelatin
