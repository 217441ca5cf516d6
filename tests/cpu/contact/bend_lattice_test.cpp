#include "cpu/contact/bend_lattice.h"

#include <gtest/gtest.h>

#include <Eigen/SVD>
#include <cmath>
#include <glm/geometric.hpp>

#include "cpu/contact/least_stretch.h"
#include "support/random_maker.h"

namespace gelatin {
namespace {

using Lattice = cpu::BendLattice<double>;

glm::dmat3 random_matrix(test::RandomMaker& random, double size) {
    return {random.point(size), random.point(size), random.point(size)};
}

TEST(LeastStretch, IsTheSmallestSingularValue) {
    test::RandomMaker random(3);
    for (int round = 0; round < 200; ++round) {
        glm::dmat3 m = random_matrix(random, 1.0);
        if (round % 3 == 0) m = glm::dmat3(1.0) + random_matrix(random, 1e-4);
        if (round % 7 == 0) m[2] = m[0] + 1e-3 * m[1];
        const Eigen::Map<const Eigen::Matrix3d> eigen(&m[0][0]);
        const double exact = Eigen::JacobiSVD<Eigen::Matrix3d>(eigen).singularValues()(2);
        EXPECT_NEAR(cpu::least_stretch(m), exact, 2e-7) << round;
        EXPECT_NEAR(cpu::least_stretch(glm::mat3(m)), exact, 3e-3) << round;
    }
    EXPECT_EQ(cpu::least_stretch(glm::dmat3(0.0)), 0.0);
}

// A lattice round random points, with random bends.
struct Bent {
    Lattice lattice;
    std::vector<glm::dvec3> offsets;
    std::vector<Lattice::Place> places;
    Lattice::Bends bends;

    explicit Bent(test::RandomMaker& random, double size = 0.1) {
        for (int k = 0; k < 400; ++k) offsets.push_back(glm::dvec3(1.0, 0.5, 0.7) * random.point(1.0));
        lattice.surround(offsets, 0.3);
        for (const glm::dvec3& offset : offsets) places.push_back(lattice.place(offset));
        lattice.weigh(places);
        bends = lattice.straight();
        for (glm::dvec4& bend : bends) bend = glm::dvec4(random.point(size), 0.0);
    }
    glm::dvec3 at(const glm::dvec3& offset) {
        EXPECT_TRUE(lattice.contains(offset));
        return lattice.bend(bends, lattice.place(offset));
    }
};

TEST(BendLattice, FitsWhatIsLinear) {
    test::RandomMaker random(5);
    Bent bent(random, 0.0);
    const glm::dmat3 linear = random_matrix(random, 0.1);
    for (int round = 0; round < 60; ++round) {
        const auto left = [&](std::size_t k) {
            return linear * bent.offsets[k] - bent.lattice.bend(bent.bends, bent.places[k]);
        };
        bent.lattice.add(bent.places, left, bent.bends);
        bent.lattice.fill_empty(bent.bends);
    }
    for (std::size_t k = 0; k < bent.offsets.size(); ++k)
        EXPECT_LT(glm::distance(bent.at(bent.offsets[k]), linear * bent.offsets[k]), 2e-3);
}

// Of the change between any two points, and of that between points near each other.
TEST(BendLattice, BoundsItsSlopes) {
    test::RandomMaker random(7);
    Bent bent(random);
    const double steepest = bent.lattice.steepest(bent.bends);
    const glm::dmat3 linear = glm::dmat3(1.0) + random_matrix(random, 0.2);
    const auto around = bent.lattice.local_maps(linear, bent.bends);
    double most_used = 0.0, most_spread = 0.0;
    for (std::size_t a = 0; a < bent.offsets.size(); ++a) {
        for (std::size_t b = 0; b < bent.offsets.size(); ++b) {
            if (a == b) continue;
            const glm::dvec3 apart = bent.offsets[b] - bent.offsets[a];
            const glm::dvec3 change = bent.at(bent.offsets[b]) - bent.at(bent.offsets[a]);
            ASSERT_LE(glm::length(change), steepest * glm::length(apart));
            most_used = std::max(most_used, glm::length(change) / (steepest * glm::length(apart)));
            if (std::max({std::abs(apart.x), std::abs(apart.y), std::abs(apart.z)}) > bent.lattice.cell())
                continue;
            const cpu::LocalMap<double>& local = around[bent.places[a].used];
            const double besides = glm::length(linear * apart + change - local.linear * apart);
            ASSERT_LE(besides, local.spread * glm::length(apart));
            most_spread = std::max(most_spread, besides / (local.spread * glm::length(apart)));
        }
    }
    EXPECT_GT(most_used, 0.15);  // bounds are not far too large
    EXPECT_GT(most_spread, 0.15);
}

TEST(BendLattice, BoundsWhatBulgesWithinFaces) {
    test::RandomMaker random(9);
    Bent bent(random);
    double most_used = 0.0;
    for (std::size_t k = 0; k < bent.offsets.size(); ++k) {
        const double size = random.magnitude(0.02, 0.4);
        std::array<glm::dvec3, 3> corners{bent.offsets[k], {}, {}};
        for (std::size_t c = 1; c < 3; ++c) {
            corners[c] = corners[0] + random.point(size);
            corners[c] =
                glm::clamp(corners[c], glm::dvec3(-0.95, -0.45, -0.65), glm::dvec3(0.95, 0.45, 0.65));
        }
        std::array<Lattice::Place, 3> places;
        std::array<glm::dvec3, 3> moved{};
        for (std::size_t c = 0; c < 3; ++c) {
            places[c] = bent.lattice.place(corners[c]);
            moved[c] = bent.at(corners[c]);
        }
        const double longest =
            std::max({glm::distance(corners[0], corners[1]), glm::distance(corners[1], corners[2]),
                      glm::distance(corners[2], corners[0])});
        Lattice::Curvatures known;
        const double bulge =
            bent.lattice.bulge(bent.bends, known, {&places[0], &places[1], &places[2]}, longest);
        for (int sample = 0; sample < 30; ++sample) {
            glm::dvec3 weights = glm::abs(random.point(1.0));
            weights /= weights.x + weights.y + weights.z;
            const glm::dvec3 point = weights.x * corners[0] + weights.y * corners[1] + weights.z * corners[2];
            const glm::dvec3 between = weights.x * moved[0] + weights.y * moved[1] + weights.z * moved[2];
            const double off = glm::distance(bent.at(point), between);
            ASSERT_LE(off, bulge);
            most_used = std::max(most_used, off / bulge);
        }
    }
    EXPECT_GT(most_used, 0.1);
}

TEST(BendLattice, BecomesFlatter) {
    test::RandomMaker random(11);
    Bent bent(random);
    for (const double most : {2.0, 0.5, 0.1}) {
        Lattice::Bends bends = bent.bends;
        const bool is_steep = bent.lattice.steepest(bends) > most;
        EXPECT_EQ(bent.lattice.flatten(bends, most), is_steep);
        EXPECT_LE(bent.lattice.steepest(bends), most);
        EXPECT_GT(bent.lattice.steepest(bends), 0.2 * std::min(most, bent.lattice.steepest(bent.bends)));
    }
}

}  // namespace
}  // namespace gelatin
