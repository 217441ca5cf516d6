#include "cpu/elasticity/elements.h"

#include <gtest/gtest.h>

#include <random>

namespace gelatin {
namespace {

using V = cpu::Vec3<double>;

class Random {
public:
    V point(double extent) { return extent * V(unit_(random_), unit_(random_), unit_(random_)); }

private:
    std::mt19937 random_{7};
    std::uniform_real_distribution<double> unit_{-1.0, 1.0};
};

// The force is minus the energy's gradient, by central differences: exact to h^2 of its third derivative.
TEST(Elements, ASpringsForceIsThatOfItsEnergy) {
    Random random;
    constexpr cpu::SpringLaw<double> kLaw{0.8, 30.0};
    constexpr double kStep = 1e-5;
    for (int i = 0; i < 200; ++i) {
        const V x = random.point(1.0), other = random.point(1.0), apart = other - x;
        if (glm::length(apart) < 0.1) continue;
        const V force = cpu::spring_pull<double>(apart, V(0), kLaw, 0.0) * apart;
        for (int k = 0; k < 3; ++k) {
            V e(0);
            e[k] = kStep;
            const double rise =
                cpu::spring_energy<double>(apart - e, kLaw) - cpu::spring_energy<double>(apart + e, kLaw);
            EXPECT_NEAR(force[k], -rise / (2 * kStep), 1e-6);
        }
    }
}

// The damper pulls back by k t / h what the spring got longer in the step.
TEST(Elements, DampersOfAStepAreSprings) {
    constexpr cpu::SpringLaw<double> kLaw{0.8, 30.0};
    constexpr double kDamping = 2.0, kStart = 0.9;  // t / h
    const V apart(0.6, 0.7, -0.2);
    const V damped = cpu::spring_pull<double>(apart, V(0), cpu::damped_spring(kLaw, kStart, kDamping), 0.0) *
                     apart,
            undamped = cpu::spring_pull<double>(apart, V(0), kLaw, 0.0) * apart;
    const double longer = glm::length(apart) - kStart;
    EXPECT_LT(glm::distance(damped - undamped, 30.0 * kDamping * longer * glm::normalize(apart)), 1e-12);
}

// k t l' along the spring, nothing across it.
TEST(Elements, DampersActAlongTheSpringAlone) {
    const V apart(2, 0, 0);
    const auto force = [&](const V& rate) {
        return cpu::spring_pull<double>(apart, rate, {2.0, 100.0}, 0.03) * apart;
    };
    EXPECT_NEAR(force({0.5, 0, 0}).x, 100.0 * 0.03 * 0.5, 1e-12);
    EXPECT_EQ(glm::length(force({0, 0.5, 0.7})), 0.0);
}

// Inertia, a hand's spring and its damper make one point spring, with the force of all three.
TEST(Elements, PointSpringsAddUp) {
    Random random;
    const double damping = 3.0;  // t / h
    for (int i = 0; i < 50; ++i) {
        const V x = random.point(1.0), start = random.point(1.0);
        const cpu::PointSpring<double> inertia{random.point(1.0), 7.0}, hand{random.point(1.0), 20.0};
        const cpu::PointSpring<double> sum =
            cpu::both(inertia, cpu::damped_point_spring(hand, start, damping));
        const V force = inertia.stiffness * (inertia.place - x) + hand.stiffness * (hand.place - x) +
                        damping * hand.stiffness * (start - x);
        EXPECT_LT(glm::distance(sum.stiffness * (sum.place - x), force), 1e-12 * glm::length(force) + 1e-12);
        EXPECT_DOUBLE_EQ(sum.stiffness, 7.0 + 20.0 * (1.0 + damping));
    }
}

TEST(Elements, ASpringOfNoLengthAddsNothing) {
    EXPECT_EQ(cpu::spring_pull<double>(V(0), V(1), {1.0, 100.0}, 0.1) * V(0), V(0));
}

// It is the slope of a potential whose curvature never exceeds |kappa|, and is kappa at rest.
TEST(Elements, VolumeStressIsNoSteeperThanItsModulus) {
    for (const double kappa : {-3.0, 2.0}) {
        EXPECT_EQ(cpu::volume_stress(1.0, kappa), 0.0);
        const double h = 1e-6;
        EXPECT_NEAR(cpu::volume_stress(1.0 + h, kappa) / h, kappa, 1e-9);
        for (double ratio = -1.0; ratio < 3.0; ratio += 0.01) {
            const double slope =
                (cpu::volume_stress(ratio + h, kappa) - cpu::volume_stress(ratio - h, kappa)) / (2 * h);
            EXPECT_LE(std::abs(slope), std::abs(kappa) + 1e-9) << ratio;
        }
    }
    EXPECT_EQ(cpu::volume_stress(1.5, -3.0), 0.0);
    EXPECT_EQ(cpu::volume_stress(-7.0, -3.0), 0.0);
}

TEST(Elements, SolvesWhatIsPositive) {
    Random random;
    for (int i = 0; i < 200; ++i) {
        const V v = random.point(1.0);
        cpu::SymmetricMatrix<double> matrix;
        matrix.add_identity(1e-3);
        for (int k = 0; k < 3; ++k) matrix.add_outer(1.0, random.point(1.0));
        EXPECT_LT(glm::distance(matrix * cpu::solve(matrix, v), v), 1e-9);
    }
}

TEST(Elements, InvertsAsItSolves) {
    Random random;
    for (int round = 0; round < 20; ++round) {
        cpu::SymmetricMatrix<double> matrix;
        for (int k = 0; k < 3; ++k) matrix.add_outer(1.0 + k, random.point(1.0));
        const V v = random.point(1.0), expected = cpu::solve(matrix, v);
        EXPECT_LT(glm::distance(cpu::inverse_of(matrix) * v, expected), 1e-9 * glm::length(expected));
    }
}

TEST(Elements, MovesNothingAlongWhatHasNoStiffness) {
    EXPECT_EQ(cpu::solve(cpu::SymmetricMatrix<double>{}, V(0)), V(0));
    const V n(0.6, 0.0, 0.8);
    cpu::SymmetricMatrix<double> matrix;
    matrix.add_outer(4.0, n);
    EXPECT_NEAR(glm::dot(cpu::solve(matrix, 2.0 * n), n), 0.5, 1e-9);
}

}  // namespace
}  // namespace gelatin
