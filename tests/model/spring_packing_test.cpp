#include "model/spring_packing.h"

#include <gtest/gtest.h>

#include <map>
#include <random>

namespace gelatin {
namespace {

std::vector<Spring> random_springs(std::uint32_t nodes, std::uint32_t count) {
    std::mt19937 random(3);
    std::uniform_int_distribution<std::uint32_t> node(0, nodes - 1);
    std::vector<Spring> springs;
    while (springs.size() < count) {
        const std::uint32_t i = node(random), j = node(random);
        const auto n = static_cast<float>(springs.size() + 1);
        if (i != j) springs.push_back({i, j, n, 10.0f * n});
    }
    return springs;
}

constexpr std::uint32_t kNodes = 3 * 64 + 17;

TEST(SpringPacking, EverySpringIsInTheRowsOfBothItsEndsAndNowhereElse) {
    const std::vector<Spring> springs = random_springs(kNodes, 900);
    const HalfSprings packed = pack_half_springs(kNodes, springs);
    ASSERT_EQ(packed.slice_starts.size(), 5u);
    ASSERT_EQ(packed.pairs.size(), packed.slice_starts.back());
    ASSERT_EQ(packed.stiffness.size(), packed.pairs.size());

    // Rest lengths are unique, so they say which spring a half is of.
    std::map<float, std::vector<std::pair<std::uint32_t, std::uint32_t>>> seen;
    for (std::uint32_t p = 0; p < packed.pairs.size(); ++p) {
        std::uint32_t slice = 0;
        while (p >= packed.slice_starts[slice + 1]) ++slice;
        const std::uint32_t node = slice * 64 + (p - packed.slice_starts[slice]) % 64;
        const HalfSpringPair& pair = packed.pairs[p];
        const auto note = [&](std::uint32_t other, float rest_length, float stiffness) {
            ASSERT_LT(other, kNodes);
            if (rest_length == 0.0f) {
                EXPECT_EQ(stiffness, 0.0f);
                EXPECT_EQ(other, std::min(node, kNodes - 1));
                return;
            }
            EXPECT_EQ(stiffness, 10.0f * rest_length);
            seen[rest_length].emplace_back(node, other);
        };
        note(pair.node_0, pair.rest_length_0, packed.stiffness[p].x);
        note(pair.node_1, pair.rest_length_1, packed.stiffness[p].y);
    }
    ASSERT_EQ(seen.size(), springs.size());
    for (const Spring& spring : springs) {
        const auto& halves = seen.at(spring.rest_length);
        ASSERT_EQ(halves.size(), 2u);
        const std::pair<std::uint32_t, std::uint32_t> forth{spring.i, spring.j}, back{spring.j, spring.i};
        EXPECT_TRUE((halves[0] == forth && halves[1] == back) || (halves[0] == back && halves[1] == forth));
    }
}

TEST(SpringPacking, IncidenceListsEachEndOnce) {
    const std::vector<Spring> springs = random_springs(kNodes, 900);
    const SpringIncidence incidence = make_incidence(kNodes, springs);
    ASSERT_EQ(incidence.starts.size(), kNodes + 1);
    ASSERT_EQ(incidence.entries.size(), 2 * springs.size());
    std::vector<int> uses(2 * springs.size(), 0);
    for (std::uint32_t n = 0; n < kNodes; ++n) {
        for (std::uint32_t e = incidence.starts[n]; e < incidence.starts[n + 1]; ++e) {
            const std::uint32_t entry = incidence.entries[e];
            ++uses[entry];
            EXPECT_EQ(entry % 2 == 0 ? springs[entry / 2].i : springs[entry / 2].j, n);
        }
    }
    for (const int use : uses) EXPECT_EQ(use, 1);
}

TEST(SpringPacking, NodesWithoutSpringsHaveEmptyRows) {
    const HalfSprings packed = pack_half_springs(70, std::vector<Spring>{});
    EXPECT_EQ(packed.slice_starts, (std::vector<std::uint32_t>{0, 0, 0}));
    EXPECT_TRUE(packed.pairs.empty());
}

}  // namespace
}  // namespace gelatin
