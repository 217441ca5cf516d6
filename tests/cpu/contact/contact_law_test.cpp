#include "cpu/contact/contact_law.h"

#include <gtest/gtest.h>

namespace gelatin {
namespace {

constexpr double kReach = 0.02, kStiffness = 500.0;

TEST(ContactLaw, ForceAndHessianAreThoseOfTheEnergy) {
    for (double gap = 1e-4; gap < 1.5 * kReach; gap *= 1.07) {
        const double h = 1e-6 * gap;
        const auto slope = [&](const auto& of) { return (of(gap + h) - of(gap - h)) / (2 * h); };
        const double force = cpu::contact_force(gap, kReach, kStiffness);
        EXPECT_NEAR(force, -slope([](double g) { return cpu::contact_energy(g, kReach, kStiffness); }),
                    1e-6 * (force + 1e-6));
        const double hessian = cpu::contact_hessian(gap, kReach, kStiffness);
        EXPECT_NEAR(hessian, -slope([](double g) { return cpu::contact_force(g, kReach, kStiffness); }),
                    1e-5 * (hessian + 1e-3));
    }
}

TEST(ContactLaw, IsContinuousAndEndsAtTheReach) {
    for (const double gap : {0.5 * kReach, kReach}) {
        const double below = gap * (1 - 1e-12), above = gap * (1 + 1e-12);
        EXPECT_NEAR(cpu::contact_energy(below, kReach, kStiffness),
                    cpu::contact_energy(above, kReach, kStiffness), 1e-9);
        EXPECT_NEAR(cpu::contact_force(below, kReach, kStiffness),
                    cpu::contact_force(above, kReach, kStiffness), 1e-9);
    }
    EXPECT_EQ(cpu::contact_energy(kReach, kReach, kStiffness), 0.0);
    EXPECT_EQ(cpu::contact_force(1.1 * kReach, kReach, kStiffness), 0.0);
    EXPECT_GT(cpu::contact_force(1e-3 * kReach, kReach, kStiffness), 200 * kStiffness * kReach);
}

}  // namespace
}  // namespace gelatin
