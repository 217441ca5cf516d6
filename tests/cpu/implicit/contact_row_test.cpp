#include "cpu/implicit/contact_row.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace gelatin {
namespace {

cpu::ContactRow<double> make_row(double limit) {
    cpu::ContactRow<double> row;
    row.normal = glm::normalize(glm::dvec3(1, 2, 2));
    row.gap = 0.8;
    row.reach = 1.0;
    row.stiffness = 3.0;
    row.hold = glm::dvec3(0.2, -0.1, 0.0);
    row.hold -= glm::dot(row.hold, row.normal) * row.normal;
    row.limit = limit;
    return row;
}

// How far along the normal, and beside it.
constexpr double kAlong[] = {0.4, 0.1, -0.2, -0.5, -0.75, -1.5}, kBeside[] = {0.0, 0.05, 0.6};

TEST(ContactRow, TangentIsTheDerivative) {
    for (const double limit : {0.0, 0.4})
        for (const double along : kAlong)
            for (const double beside : kBeside) {
                const cpu::ContactRow<double> row = make_row(limit);
                const glm::dvec3 across = glm::normalize(glm::cross(row.normal, glm::dvec3(0, 0, 1)));
                const glm::dvec3 s = along * row.normal + beside * across;
                const cpu::RowTangent<double> tangent = cpu::tangent(row, s);
                EXPECT_LT(glm::length(tangent.force(s) - row.force(s)), 1e-12);
                for (const glm::dvec3& d : {row.normal, across, glm::cross(row.normal, across)}) {
                    constexpr double kStep = 1e-6;
                    const glm::dvec3 derivative =
                        (row.force(s + kStep * d) - row.force(s - kStep * d)) / (2 * kStep);
                    // Contacts and stuck friction exactly; of a slip, what turns it is left out nowhere.
                    EXPECT_LT(glm::length(derivative + tangent.stiffness * d), 1e-4)
                        << limit << ' ' << along << ' ' << beside;
                }
            }
}

TEST(ContactRow, FrictionIsLimited) {
    const cpu::ContactRow<double> row = make_row(0.4);
    for (const double beside : {0.0, 0.1, 1.0, 100.0}) {
        const glm::dvec3 across = glm::normalize(glm::cross(row.normal, glm::dvec3(0, 0, 1)));
        EXPECT_LE(glm::length(row.held(beside * across)), 0.4 + 1e-12);
    }
}

// A tie without limits has one tangent everywhere, and nothing else has.
TEST(ContactRow, TiesWithoutLimitsAreLinear) {
    constexpr double kNone = std::numeric_limits<double>::max();
    cpu::ContactRow<double> tie;
    tie.attachment = 0;
    tie.stiffness = 3.0;
    tie.hold = {0.2, -0.1, 0.3};
    tie.gap = tie.limit = kNone;
    cpu::ContactRow<double> rail = tie, stop = tie, weak = tie;
    for (cpu::ContactRow<double>* row : {&rail, &stop, &weak}) {
        row->normal = {0.6, 0.0, 0.8};
        row->is_along = true;
        row->least = -kNone;
    }
    stop.least = 0.0;
    weak.limit = 0.5;
    const auto has_one_tangent = [](const cpu::ContactRow<double>& row) {
        const glm::dvec3 s(0.3, -0.7, 0.2);
        const cpu::RowTangent<double> t = cpu::tangent(row, s);
        return glm::distance(t.force(-s), row.force(-s)) < 1e-12;
    };
    for (const auto& row : {tie, rail}) {
        EXPECT_TRUE(row.is_linear());
        EXPECT_TRUE(has_one_tangent(row));
    }
    for (const auto& row : {stop, weak, make_row(0.0), make_row(0.4)}) {
        EXPECT_FALSE(row.is_linear());
        EXPECT_FALSE(has_one_tangent(row));
    }
}

// From the least gap on inwards the force grows linearly, without a jump.
TEST(ContactRow, GoesOnBeyondTheLeastGap) {
    const cpu::ContactRow<double> row = make_row(0.0);
    const double least = cpu::ContactRow<double>::kLeastGap;
    EXPECT_NEAR(row.force_of(least - 1e-9), row.force_of(least + 1e-9), 1e-5);
    EXPECT_NEAR(row.force_of(-1.0) - row.force_of(0.0), row.force_of(-2.0) - row.force_of(-1.0), 1e-9);
    EXPECT_GT(row.force_of(-1.0), row.force_of(0.0));
    EXPECT_EQ(row.force_of(1.0), 0.0);
}

}  // namespace
}  // namespace gelatin
