#include "cpu/elasticity/elements.h"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <functional>
#include <glm/matrix.hpp>
#include <random>

#include "support/eigen_modes.h"

namespace gelatin {
namespace {

using V = cpu::Vec3<double>;
using M = glm::dmat3;
using Terms = cpu::NodeTerms<double>;

class Random {
public:
    V point(double extent) { return extent * V(unit_(random_), unit_(random_), unit_(random_)); }

private:
    std::mt19937 random_{7};
    std::uniform_real_distribution<double> unit_{-1.0, 1.0};
};

M glm_matrix(const cpu::SymmetricMatrix<double>& s) {
    return {s.diagonal.x, s.beside.z, s.beside.y, s.beside.z,  s.diagonal.y,
            s.beside.x,   s.beside.y, s.beside.x, s.diagonal.z};
}

Eigen::Matrix3d to_eigen(const cpu::SymmetricMatrix<double>& s);
Eigen::Matrix3d to_eigen(const M& m) {
    Eigen::Matrix3d result;
    for (int c = 0; c < 3; ++c) {
        for (int r = 0; r < 3; ++r) result(r, c) = m[c][r];
    }
    return result;
}

Eigen::Matrix3d to_eigen(const cpu::SymmetricMatrix<double>& s) {
    return to_eigen(glm_matrix(s));
}

// The force is minus the energy's gradient, by central differences: exact to h^2 of its third derivative.
void expect_force_of(const std::function<double(const V&)>& energy, const V& x, const V& force,
                     double bound) {
    const double h = 1e-5;
    for (int k = 0; k < 3; ++k) {
        V e(0);
        e[k] = h;
        EXPECT_NEAR(force[k], -(energy(x + e) - energy(x - e)) / (2 * h), bound);
    }
}

// So is the Hessian minus the force's derivative.
M derivative_of(const std::function<V(const V&)>& force, const V& x) {
    const double h = 1e-5;
    M result;
    for (int k = 0; k < 3; ++k) {
        V e(0);
        e[k] = h;
        result[k] = -(force(x + e) - force(x - e)) / (2 * h);
    }
    return result;
}

constexpr double kRest = 0.8, kStiffness = 30.0;

Terms spring_terms(const V& x, const V& other, double damping = 0.0, const V& start = V(0)) {
    Terms terms;
    const cpu::SpringLaw<double> spring{kRest, kStiffness};
    cpu::add_spring(other - x, cpu::damped_spring(spring, glm::distance(other, start), damping), terms);
    return terms;
}

TEST(Elements, ASpringsForceAndHessianAreThoseOfItsEnergy) {
    Random random;
    const double bound = 1e-5;  // h^2 k L / l^3 is 2.4e-6 at the shortest, and there are several terms
    int stretched = 0;
    for (int i = 0; i < 200; ++i) {
        const V x = random.point(1.0), other = random.point(1.0);
        if (glm::distance(x, other) < 0.1) continue;
        const Terms terms = spring_terms(x, other);
        const auto energy = [&](const V& p) {
            return cpu::spring_energy<double>(other - p, {kRest, kStiffness});
        };
        expect_force_of(energy, x, terms.force, 1e-6);
        const V apart = other - x;
        const V explicitly = cpu::spring_pull<double>(apart, V(0), {kRest, kStiffness}, 0.0) * apart;
        EXPECT_LT(glm::distance(explicitly, terms.force), 1e-12);
        const M exact = derivative_of([&](const V& p) { return spring_terms(p, other).force; }, x);
        const Eigen::VectorXd given = test::eigen_modes(to_eigen(terms.hessian)).values,
                              wanted = test::eigen_modes(to_eigen(exact)).values;
        if (glm::distance(x, other) > kRest) {
            ++stretched;
            EXPECT_LT((to_eigen(terms.hessian) - to_eigen(exact)).norm(), bound);
        } else {  // its negative part left out
            EXPECT_NEAR(given[2], wanted[2], bound);
            EXPECT_NEAR(given[1], 0.0, 1e-9);
        }
        EXPECT_GE(given[0], -1e-9);
    }
    EXPECT_GT(stretched, 50);
}

// The damper pulls back by k t / h what the spring got longer in the step, and lets it turn.
TEST(Elements, DampingResistsChangesOfLengthAlone) {
    const V start(0, 0, 0), other(kRest, 0, 0), moved(0.1, 0.2, 0);
    const double damping = 2.0;  // t / h
    const auto damper = [&](const V& at) {
        return spring_terms(at, other, damping, start).force - spring_terms(at, other).force;
    };
    const V n = glm::normalize(other - moved);
    const double longer = glm::distance(other, moved) - kRest;
    EXPECT_LT(glm::distance(damper(moved), kStiffness * damping * longer * n), 1e-12);
    const V turned = other + kRest * glm::normalize(V(-1, 2, 3));
    EXPECT_LT(glm::length(damper(turned)), 1e-12);
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

TEST(Elements, APointSpringsForceAndHessianAreThoseOfItsEnergy) {
    Random random;
    for (int i = 0; i < 50; ++i) {
        const V x = random.point(1.0), place = random.point(1.0);
        const auto terms_at = [&](const V& p) {
            Terms terms;
            cpu::add_point_spring(place - p, kStiffness, terms);
            return terms;
        };
        const auto energy = [&](const V& p) { return cpu::point_spring_energy(place - p, kStiffness); };
        expect_force_of(energy, x, terms_at(x).force, 1e-8);
        const M exact = derivative_of([&](const V& p) { return terms_at(p).force; }, x);
        EXPECT_LT((to_eigen(terms_at(x).hessian) - to_eigen(exact)).norm(), 1e-8);
    }
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
    const Terms terms = spring_terms(V(1, 2, 3), V(1, 2, 3), 2.0, V(0));
    EXPECT_EQ(terms.force, V(0));
    EXPECT_EQ(terms.hessian.diagonal, V(0));
    EXPECT_EQ(terms.hessian.beside, V(0));
}

TEST(Elements, AFlatTetsForceAndHessianAreThoseOfItsEnergy) {
    Random random;
    const double volume = 0.02, modulus = 5e3;
    int resisting = 0;
    for (int i = 0; i < 200; ++i) {
        const V x = random.point(0.5);
        const std::array<V, 3> face{random.point(0.5), random.point(0.5), random.point(0.5)};
        const auto terms_at = [&](const V& p) {
            Terms terms;
            const V slope = cpu::volume_slope(face[1] - face[0], face[2] - face[0], 1.0 / (6.0 * volume));
            cpu::add_flat_tet(slope, glm::dot(p - face[0], slope), volume * modulus, terms);
            return terms;
        };
        const auto energy = [&](const V& p) {
            const double v = glm::dot(p - face[0], glm::cross(face[1] - face[0], face[2] - face[0])) / 6.0;
            return cpu::flat_tet_energy(v / volume, volume * modulus);
        };
        const Terms terms = terms_at(x);
        if (terms.force == V(0)) {
            EXPECT_EQ(energy(x), 0.0);
            continue;
        }
        ++resisting;
        expect_force_of(energy, x, terms.force, 1e-5 * glm::length(terms.force) + 1e-6);
        const M exact = derivative_of([&](const V& p) { return terms_at(p).force; }, x);
        EXPECT_LT((to_eigen(terms.hessian) - to_eigen(exact)).norm(), 1e-5 * to_eigen(exact).norm() + 1e-6);
    }
    EXPECT_GT(resisting, 50);
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

TEST(Elements, ATetsVolumeTermIsThatOfItsEnergy) {
    Random random;
    const double volume = 0.02, offset = 300.0, modulus = 5e3;
    for (int i = 0; i < 200; ++i) {
        const V x = random.point(0.5);
        const std::array<V, 3> face{random.point(0.5), random.point(0.5), random.point(0.5)};
        const auto terms_at = [&](const V& p) {
            Terms terms;
            const V slope = cpu::volume_slope(face[1] - face[0], face[2] - face[0], 1.0 / (6.0 * volume));
            cpu::add_tet_volume(slope, glm::dot(p - face[0], slope), {volume * offset, volume * modulus},
                                terms);
            return terms;
        };
        const auto energy = [&](const V& p) {
            const double v = glm::dot(p - face[0], glm::cross(face[1] - face[0], face[2] - face[0])) / 6.0;
            return cpu::volume_bound_energy<double>(v / volume, {volume * offset, volume * modulus});
        };
        const Terms terms = terms_at(x);
        expect_force_of(energy, x, terms.force, 1e-5 * glm::length(terms.force) + 1e-6);
        const M exact = derivative_of([&](const V& p) { return terms_at(p).force; }, x);
        EXPECT_LT((to_eigen(terms.hessian) - to_eigen(exact)).norm(), 1e-5 * to_eigen(exact).norm() + 1e-6);
    }
}

TEST(Elements, SolvesWhatIsPositive) {
    Random random;
    for (int i = 0; i < 200; ++i) {
        Terms terms{random.point(1.0), {}};
        terms.hessian.add_identity(1e-3);
        for (int k = 0; k < 3; ++k) terms.hessian.add_outer(1.0, random.point(1.0));
        EXPECT_LT(glm::distance(glm_matrix(terms.hessian) * cpu::solve(terms), terms.force), 1e-9);
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
    EXPECT_EQ(cpu::solve(Terms{}), V(0));
    const V n(0.6, 0.0, 0.8);
    Terms terms{2.0 * n, {}};
    terms.hessian.add_outer(4.0, n);
    EXPECT_NEAR(glm::dot(cpu::solve(terms), n), 0.5, 1e-9);
}

}  // namespace
}  // namespace gelatin
