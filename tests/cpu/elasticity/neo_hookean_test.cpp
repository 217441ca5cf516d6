#include "cpu/elasticity/neo_hookean.h"

#include <gtest/gtest.h>

#include <functional>
#include <glm/gtc/quaternion.hpp>
#include <random>

#include "model/elasticity/neo_hookean.h"
#include "support/draw_vector.h"

namespace gelatin {
namespace {

using V = cpu::Vec3<double>;
using M = cpu::Mat3<double>;
using Corners = std::array<V, 4>;

constexpr NeoHookeanModuli kModuli{3e4, 2e5, 0.0};  // [Pa]

class RandomTets {
public:
    double number() { return unit_(random_); }
    V point() { return {number(), number(), number()}; }
    M matrix() { return {point(), point(), point()}; }
    M rotation() { return glm::mat3_cast(test::draw_rotation(unit_, random_)); }

private:
    std::mt19937 random_{11};
    std::uniform_real_distribution<double> unit_{-1.0, 1.0};
};

const Corners kRestTet{V(0.1, 0, 0), V(0.9, 0.1, 0), V(0.2, 0.8, -0.1), V(0.3, 0.2, 0.7)};

NeoHookeanTet make_tet() {
    return make_neo_hookean_tet({0, 1, 2, 3}, kRestTet, kModuli);
}
double volume_of(const NeoHookeanTet& tet) {
    return static_cast<double>(tet.gradient_1.w);
}
double mu_of(const NeoHookeanTet& tet) {
    return static_cast<double>(tet.gradient_2.w);
}
double energy_of(const NeoHookeanTet& tet, const Corners& x) {
    return cpu::neo_hookean_energy(cpu::gradient_of(tet, x), cpu::tet_moduli<double>(tet));
}

V force_on(const NeoHookeanTet& tet, std::uint32_t corner, const Corners& x, const Corners& v = {},
           double damping_time = 0.0) {
    glm::dvec4 positions[4], velocities[4];
    for (std::size_t k = 0; k < 4; ++k) {
        positions[k] = glm::dvec4(x[k], 1.0);
        velocities[k] = glm::dvec4(v[k], damping_time);
    }
    return cpu::neo_hookean_force(tet, corner, positions, velocities);
}

// Shapes of all kinds: anything, inverted, flat, a line.
std::vector<Corners> make_shapes() {
    RandomTets random;
    std::vector<Corners> shapes;
    for (int i = 0; i < 40; ++i) {
        Corners any{random.point(), random.point(), random.point(), random.point()}, mirrored = kRestTet,
                                                                                     flat = any, line = any;
        for (V& p : mirrored) p.x *= -1.0 + 0.3 * random.number();
        for (V& p : flat) p.y = 0.5;
        for (V& p : line) p = V(0.3, p.y, 0.2);
        shapes.insert(shapes.end(), {any, mirrored, flat, line});
    }
    return shapes;
}

V central_difference(const std::function<double(const V&)>& value) {
    const double h = 1e-5;
    V slope;
    for (int k = 0; k < 3; ++k) {
        V e(0);
        e[k] = h;
        slope[k] = (value(e) - value(-e)) / (2 * h);
    }
    return slope;
}

TEST(NeoHookean, IsAtRestAtRest) {
    const NeoHookeanTet tet = make_tet();
    EXPECT_NEAR(energy_of(tet, kRestTet), 0.0, 1e-4);  // rest in single precision: 1e-7 of mu
    for (std::uint32_t k = 0; k < 4; ++k) EXPECT_LT(glm::length(force_on(tet, k, kRestTet)), 0.05);
}

TEST(NeoHookean, ForcesAreTheGradientOfTheEnergyForAnyShape) {
    const NeoHookeanTet tet = make_tet();
    int inverted = 0;
    for (const Corners& x : make_shapes()) {
        inverted += glm::determinant(cpu::gradient_of(tet, x)) < 0.0 ? 1 : 0;
        V sum(0), torque(0);
        for (std::uint32_t k = 0; k < 4; ++k) {
            const V force = force_on(tet, k, x);
            const V slope = central_difference([&](const V& d) {
                Corners moved = x;
                moved[k] += d;
                return energy_of(tet, moved);
            });
            const double scale = glm::length(slope) + mu_of(tet);
            EXPECT_LT(glm::distance(force, -slope), 1e-7 * scale);
            sum += force;
            torque += glm::cross(x[k], force);
        }
        EXPECT_LT(glm::length(sum), 1e-10 * mu_of(tet) + 1e-12 * energy_of(tet, x));
        EXPECT_LT(glm::length(torque), 1e-10 * mu_of(tet) + 1e-12 * energy_of(tet, x));
    }
    EXPECT_GT(inverted, 50);
}

TEST(NeoHookean, DoesNotSeeRotations) {
    RandomTets random;
    for (int i = 0; i < 50; ++i) {
        const M turn = random.rotation(), f = random.matrix();
        const cpu::TetModuli<double> moduli{kModuli.mu, kModuli.lambda};
        const double energy = cpu::neo_hookean_energy(f, moduli);
        EXPECT_NEAR(cpu::neo_hookean_energy<double>(turn * f, moduli), energy, 1e-11 * kModuli.lambda);
        EXPECT_NEAR(cpu::neo_hookean_energy<double>(f * turn, moduli), energy, 1e-11 * kModuli.lambda);
    }
}

// Small strains: stress 2 mu_L e + lambda_L tr e, to second order in e.
TEST(NeoHookean, IsHookesLawAtSmallStrains) {
    RandomTets random;
    for (const double nu : {0.0, 0.25, 0.45}) {
        const double youngs = 1e5, shear = youngs / (2 * (1 + nu)), lame = 2 * shear * nu / (1 - 2 * nu);
        const NeoHookeanModuli moduli = neo_hookean_moduli(youngs, nu);
        for (int i = 0; i < 20; ++i) {
            const double size = 1e-5;
            const M change = size * random.matrix(), f = M(1.0) + change;
            const M strain = 0.5 * (change + glm::transpose(change));
            const M hooke = 2.0 * shear * strain + M(lame * (strain[0].x + strain[1].y + strain[2].z));
            const M cofactors = cpu::cofactor<double>(f);
            const double squares = cpu::double_dot(f, f);
            const cpu::NeoHookeanStress<double> s = cpu::neo_hookean_stress<double>(
                squares, 1.0 / (squares + 1.0), glm::determinant(f), {moduli.mu, moduli.lambda});
            const double averaged = moduli.kappa * (glm::determinant(f) - 1.0);
            const M stress = s.shear * f + (s.pressure + averaged) * cofactors;
            for (int c = 0; c < 3; ++c)
                EXPECT_LT(glm::distance(stress[c], hooke[c]),
                          20.0 * size * size * (moduli.lambda + moduli.kappa));
        }
    }
}

// A point has no stress; the tet opens the way it lies at rest.
TEST(NeoHookean, APointOpensAsItWas) {
    const NeoHookeanTet tet = make_tet();
    const Corners point{V(2.0), V(2.0), V(2.0), V(2.0)};
    for (std::uint32_t k = 0; k < 4; ++k) {
        const V expected = volume_of(tet) * mu_of(tet) * cpu::shape_gradient<double>(tet, k);
        EXPECT_LT(glm::distance(force_on(tet, k, point), expected), 1e-9);
    }
}

TEST(NeoHookeanViscosity, LeavesRigidMotionAlone) {
    const NeoHookeanTet tet = make_tet();
    RandomTets random;
    for (int i = 0; i < 20; ++i) {
        const Corners x{random.point(), random.point(), random.point(), random.point()};
        const V spin = 10.0 * random.point(), drift = random.point();
        Corners v;
        for (std::size_t k = 0; k < 4; ++k) v[k] = drift + glm::cross(spin, x[k]);
        for (std::uint32_t k = 0; k < 4; ++k) {
            const V still = force_on(tet, k, x);
            EXPECT_LT(glm::distance(force_on(tet, k, x, v, 0.1), still),
                      1e-10 * (glm::length(still) + mu_of(tet)));
        }
    }
}

// Its power is never positive; at rest it is t times the elastic force of a displacement that is the
// velocity.
TEST(NeoHookeanViscosity, TakesEnergyAndIsKelvinVoigts) {
    const NeoHookeanTet tet = make_tet();
    RandomTets random;
    const double damping_time = 0.02, size = 1e-5;
    for (int i = 0; i < 50; ++i) {
        const Corners x{random.point(), random.point(), random.point(), random.point()};
        const Corners v{random.point(), random.point(), random.point(), random.point()};
        double power = 0.0;
        Corners moved;
        for (std::size_t k = 0; k < 4; ++k) moved[k] = kRestTet[k] + size * v[k];
        for (std::uint32_t k = 0; k < 4; ++k) {
            power += glm::dot(v[k], force_on(tet, k, x, v, damping_time) - force_on(tet, k, x));
            const V viscous = force_on(tet, k, kRestTet, v, damping_time) - force_on(tet, k, kRestTet);
            const V elastic = (force_on(tet, k, moved) - force_on(tet, k, kRestTet)) / size;
            EXPECT_LT(glm::distance(viscous, damping_time * elastic), 2e-3 * glm::length(viscous) + 1.0);
        }
        EXPECT_LT(power, 0.0);
    }
}

}  // namespace
}  // namespace gelatin
