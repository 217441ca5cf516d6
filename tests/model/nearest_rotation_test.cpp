#include "model/nearest_rotation.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/matrix.hpp>

namespace gelatin {
namespace {

double difference(const glm::dmat3& a, const glm::dmat3& b) {
    double worst = 0.0;
    for (int k = 0; k < 3; ++k) worst = std::max(worst, glm::distance(a[k], b[k]));
    return worst;
}

TEST(NearestRotation, IsTheRotationThatWasMade) {
    const glm::dmat3 spread(glm::dvec3(3, 0.5, 0), glm::dvec3(0.5, 2, 0.1), glm::dvec3(0, 0.1, 1));
    for (const glm::dvec3& axis : {glm::dvec3(0.3, -0.2, 0.1), glm::dvec3(5, 40, -7), glm::dvec3(1, 0, 0)}) {
        for (const double angle : {0.0, 0.4, 2.0, 3.1, 3.141592653589793}) {
            const glm::dquat q = glm::angleAxis(angle, glm::normalize(axis));
            const glm::dmat3 moment = glm::mat3_cast(q) * spread;
            EXPECT_LT(difference(nearest_rotation(moment), glm::mat3_cast(q)), 1e-12);
            const glm::dquat found = smallest_nearest_rotation(moment);
            EXPECT_GE(found.w, 0.0);
            EXPECT_LT(difference(glm::mat3_cast(found), glm::mat3_cast(q)), 1e-9);
        }
    }
}

TEST(NearestRotation, IsProperForAnyMoment) {
    const glm::dmat3 mirrored(glm::dvec3(1, 0, 0), glm::dvec3(0, -2, 0), glm::dvec3(0, 0, 3));
    for (const glm::dmat3& moment : {mirrored, glm::dmat3(0.0), -glm::dmat3(1.0)}) {
        for (const glm::dmat3& rotation :
             {nearest_rotation(moment), glm::mat3_cast(smallest_nearest_rotation(moment))}) {
            EXPECT_NEAR(glm::determinant(rotation), 1.0, 1e-12);
            EXPECT_LT(difference(rotation * glm::transpose(rotation), glm::dmat3(1.0)), 1e-12);
        }
    }
}

// Nodes on a line leave the rotation about it open, a single one leaves all: neither is to rotate more than
// the line does.
TEST(NearestRotation, IsTheSmallestOfSeveral) {
    EXPECT_NEAR(smallest_nearest_rotation(glm::dmat3(0.0)).w, 1.0, 1e-12);
    const glm::dvec3 line = glm::normalize(glm::dvec3(1, 2, -1)), across(2, -1, 0);  // at right angles
    for (const double angle : {0.0, 1e-3, 0.7, 3.0}) {
        const glm::dquat q = glm::angleAxis(angle, glm::normalize(across));
        const glm::dquat found = smallest_nearest_rotation(glm::outerProduct(q * line, line));
        EXPECT_NEAR(std::abs(glm::dot(found, q)), 1.0, 1e-12) << angle;
    }
}

}  // namespace
}  // namespace gelatin
