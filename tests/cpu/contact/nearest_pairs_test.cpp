#include "cpu/contact/nearest_pairs.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <vector>

#include "cpu/collision/nearest_points.h"
#include "support/instruction_sets.h"
#include "support/random_maker.h"

namespace gelatin {
namespace {

// Pairs at random: apart, near each other, parallel, and of no extent.
template <class Real>
struct Pairs {
    explicit Pairs(bool are_edges, unsigned seed) {
        test::RandomMaker random(seed);
        for (std::uint32_t p = 0; p < 203; ++p) {
            std::array<glm::dvec3, 4> nodes;
            for (glm::dvec3& node : nodes) node = random.point();
            const int kind = random.integer(0, 4);
            const std::size_t second = are_edges ? 2 : 1;
            if (kind == 1) nodes[second] = nodes[0] + random.point(1e-3);
            if (kind == 2)
                nodes[3] = nodes[2] + 0.5 * (nodes[1] - nodes[are_edges ? 0 : 2]);  // parallel, or thin
            if (kind == 3) nodes[3] = nodes[2];
            for (glm::dvec3& node : nodes) node += glm::dvec3(3.0, -2.0, 1.0);
            const std::uint32_t first = 4 * p;
            pairs.push_back(
                {{first, first + 1, first + 2, first + 3}, 0, 0, 0, 1, are_edges ? 2u : 1u, 0.1f});
            for (const glm::dvec3& node : nodes) positions.emplace_back(cpu::Vec3<Real>(node), Real(1));
        }
    }
    glm::dvec3 at(const cpu::ContactPair& pair, std::size_t k) const {
        return glm::dvec3(positions[pair.nodes[k]]);
    }

    std::vector<cpu::ContactPair> pairs;
    std::vector<cpu::Vec4<Real>> positions;
};

glm::dvec3 exactly_apart(const cpu::ContactPair& pair, const std::array<glm::dvec3, 4>& n) {
    if (pair.is_edges())
        return cpu::nearest_points<double>(std::array{n[0], n[1]}, std::array{n[2], n[3]}).apart;
    return cpu::nearest_points<double>(n[0], std::array{n[1], n[2], n[3]}).apart;
}

template <class Real>
void expect_right(bool are_edges, double bound) {
    const Pairs<Real> test(are_edges, 5);
    std::size_t measured_pairs = 0;
    cpu::for_measured<Real>(
        test.pairs, test.positions,
        [&](std::size_t p, const cpu::MeasuredPairs<Real>& measured, std::size_t c) {
            EXPECT_EQ(p, measured_pairs++);  // each once, in their order
            const cpu::ContactPair& pair = test.pairs[p];
            const glm::dvec3 apart(measured.apart[0][c], measured.apart[1][c], measured.apart[2][c]);
            const glm::dvec3 normal = measured.gaps[c] > Real(0) ? glm::normalize(apart) : apart;
            std::array<glm::dvec3, 4> nodes;
            for (std::size_t k = 0; k < 4; ++k) nodes[k] = test.at(pair, k);
            glm::dvec3 between(0.0);
            double sums[2] = {0.0, 0.0}, low = 1e30, top = -1e30;
            for (std::size_t k = 0; k < 4; ++k) {
                const auto weight = static_cast<double>(measured.weights[k][c]);
                EXPECT_GE(weight, -bound);
                sums[pair.side_of(k)] += weight;
                between += (pair.side_of(k) == 0 ? -weight : weight) * nodes[k];
                const double height = glm::dot(normal, nodes[k] - nodes[0]);
                if (pair.side_of(k) == 0) {
                    top = std::max(top, height);
                } else {
                    low = std::min(low, height);
                }
            }
            const glm::dvec3 exact = exactly_apart(pair, nodes);
            EXPECT_NEAR(sums[0], 1.0, bound);
            EXPECT_NEAR(sums[1], 1.0, bound);
            EXPECT_NEAR(glm::length(apart), glm::length(exact), bound);
            EXPECT_LT(glm::distance(apart, between), bound);
            EXPECT_NEAR(measured.gaps[c], glm::length(apart), bound);
            // The direction separates both sides by the gap.
            EXPECT_NEAR(low - top, glm::length(exact), bound + static_cast<double>(measured.rounding[c]));
        });
    EXPECT_EQ(measured_pairs, test.pairs.size());
}

TEST(NearestPairs, AreThoseOfNodesFacesAndEdges) {
    for (const bool are_edges : {false, true}) {
        expect_right<double>(are_edges, 1e-6);  // pairs are parallel up to some rounding
        test::with_each_instruction_set([&] { expect_right<float>(are_edges, 2e-3); });
    }
}

}  // namespace
}  // namespace gelatin
