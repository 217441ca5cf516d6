#include "model/drive/cavity.h"

#include <gtest/gtest.h>

#include <cmath>

namespace gelatin {
namespace {

Cavity cavity_of(const CavityDescription& gas) {
    Cavity cavity;
    cavity.gas = gas;
    cavity.rest_volume = 0.02;
    return cavity;
}

// p = -dE/dV, and its stiffness -dp/dV, of both laws.
TEST(Cavity, PressureIsMinusTheDerivativeOfTheEnergy) {
    constexpr double kStep = 1e-7;
    for (const GasLaw law : {GasLaw::sealed, GasLaw::constant}) {
        const Cavity cavity = cavity_of({.law = law, .pressure = 3e4});
        const double drive = law == GasLaw::sealed ? 1.5 : 2e4;
        for (const double volume : {0.01, 0.02, 0.05}) {
            const double p = cavity.pressure(drive, volume);
            EXPECT_NEAR(
                (cavity.energy(drive, volume - kStep) - cavity.energy(drive, volume + kStep)) / (2.0 * kStep),
                p, 1e-5 * 1e5);
            EXPECT_NEAR((cavity.pressure(drive, volume - kStep) - cavity.pressure(drive, volume + kStep)) /
                            (2.0 * kStep),
                        cavity.stiffness(drive, volume), 1e-5 * (1.0 + cavity.stiffness(drive, volume)));
        }
    }
}

TEST(Cavity, SealedGasIsIsothermal) {
    const Cavity cavity = cavity_of({.pressure = 1e4, .ambient = 9e4});
    EXPECT_DOUBLE_EQ(cavity.pressure(1.0, 0.02), 1e4);
    EXPECT_DOUBLE_EQ(cavity.pressure(1.0, 0.01), 1.1e5);
    EXPECT_DOUBLE_EQ(cavity.pressure(2.0, 0.02), 1.1e5);
    EXPECT_EQ(cavity.energy(1.0, 0.02), 0.0);
}

TEST(Cavity, KeyframesAreLinearBetween) {
    Cavity cavity = cavity_of({.law = GasLaw::constant, .pressure = 7.0});
    EXPECT_EQ(cavity.drive_at(5.0, {}), 7.0);
    cavity.gas.keyframes = {{.time = 1.0, .pressure = 10.0}, {.time = 3.0, .pressure = 30.0}};
    EXPECT_EQ(cavity.drive_at(0.0, {}), 10.0);
    EXPECT_EQ(cavity.drive_at(1.0, {}), 10.0);
    EXPECT_DOUBLE_EQ(cavity.drive_at(1.5, {}), 15.0);
    EXPECT_EQ(cavity.drive_at(3.0, {}), 30.0);
    EXPECT_EQ(cavity.drive_at(9.0, {}), 30.0);
    EXPECT_EQ(cavity.drive_at(9.0, CavityGas{.pressure = 4.0}), 4.0);
    const Cavity sealed = cavity_of({.amount = 1.25});
    EXPECT_EQ(sealed.drive_at(2.0, {}), 1.25);
    EXPECT_EQ(sealed.drive_at(2.0, CavityGas{.amount = 2.0}), 2.0);
}

// From far away as exactly as from near.
TEST(Cavity, VolumeIsExactFarFromTheOrigin) {
    const std::vector<glm::uvec3> faces{{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
    std::vector<glm::dvec3> positions{{0, 0, 0}, {0.5, 0, 0}, {0, 0.5, 0}, {0, 0, 0.5}};
    for (glm::dvec3& p : positions) p += glm::dvec3(4096.0, -8192.0, 512.0);
    EXPECT_DOUBLE_EQ(enclosed_volume<glm::dvec3>(faces, positions), 0.125 / 6.0);
}

}  // namespace
}  // namespace gelatin
