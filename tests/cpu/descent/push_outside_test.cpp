// What a collider does to a node after its Newton step, on a plane: the node's part of the objective is then
// a quadratic with the Hessian H, which the pushed node minimises under the collider's forces.
#include "cpu/descent/push_outside.h"
#include "support/draw_vector.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>

namespace gelatin {
namespace {

using V = cpu::Vec3<double>;
using Contact = cpu::ColliderContact<double>;

const V kNormal(0.6, 0.8, 0.0);
constexpr double kDepth = 0.02;  // [m]

Collider make_plane(double friction) {
    Collider plane{};
    plane.kind = 0;
    plane.center = glm::vec4(glm::vec3(kNormal), 0.0f);
    plane.friction = static_cast<float>(friction);
    return plane;
}

class PushOutside : public ::testing::Test {
protected:
    V point() { return {unit_(random_), unit_(random_), unit_(random_)}; }
    V along_plane() {
        const V p = point();
        return p - glm::dot(p, kNormal) * kNormal;
    }
    cpu::SymmetricMatrix<double> stiffness() {
        cpu::SymmetricMatrix<double> hessian;
        hessian.add_identity(50.0);
        for (int k = 0; k < 3; ++k) hessian.add_outer(200.0, point());
        return hessian;
    }
    static double height(const V& p) { return glm::dot(p, V(make_plane(0.0).center)); }

    static Contact push(double friction, const V& start, const cpu::SymmetricMatrix<double>& hessian, V& at) {
        Contact contact;
        EXPECT_TRUE(cpu::push_outside(make_plane(friction), start, hessian, at, contact));
        return contact;
    }

private:
    std::mt19937 random_{11};
    std::uniform_real_distribution<double> unit_{-1.0, 1.0};
};

TEST_F(PushOutside, TheForceIsWhatHoldsTheNodeThere) {
    for (const double friction : {0.0, 0.3, 100.0}) {
        for (int i = 0; i < 100; ++i) {
            const auto hessian = stiffness();
            const V newton = along_plane() - kDepth * kNormal, start = newton + 0.1 * point();
            V at = newton;
            const Contact contact = push(friction, start, hessian, at);
            EXPECT_NEAR(height(at), 0.0, 1e-7);  // the plane is one of floats
            const V lacking = hessian * (at - newton) - contact.force;
            EXPECT_LT(glm::length(lacking), 1e-3 * glm::length(contact.force));
            if (friction == 0.0) {
                EXPECT_LT(glm::length(lacking), 1e-9);
            }
            const double pressing = glm::dot(contact.force, kNormal);
            const V rubbing = contact.force - pressing * kNormal;
            EXPECT_GT(pressing, 0.0);
            EXPECT_LE(glm::length(rubbing), friction * pressing * (1.0 + 1e-6) + 1e-6);
        }
    }
}

TEST_F(PushOutside, FrictionHoldsANodeOrActsAgainstItsSliding) {
    int held = 0, slides = 0;
    for (int i = 0; i < 200; ++i) {
        const auto hessian = stiffness();
        const V newton = along_plane() - kDepth * kNormal, start = newton + 0.02 * point();
        V at = newton;
        const Contact contact = push(0.5, start, hessian, at);
        const double pressing = glm::dot(contact.force, kNormal);
        const V rubbing = contact.force - pressing * kNormal;
        V slip = at - start;
        slip -= glm::dot(slip, kNormal) * kNormal;
        if (glm::length(rubbing) < 0.5 * pressing * (1.0 - 1e-5)) {
            ++held;
            EXPECT_LT(glm::length(slip), 1e-8);  // the plane's normal is one of floats
            EXPECT_EQ(contact.across, contact.along);
        } else {
            ++slides;
            EXPECT_NEAR(glm::length(rubbing), 0.5 * pressing, 1e-5 * pressing);
            EXPECT_LT(glm::length(glm::normalize(rubbing) + glm::normalize(slip)), 1e-3);
            EXPECT_LE(contact.across, contact.along);
        }
    }
    EXPECT_GT(held, 20);
    EXPECT_GT(slides, 20);
}

// However much stiffer it is across one direction than along it.
TEST(FrictionOnASlip, ActsAlongWhatIsLeft) {
    std::mt19937 random(5);
    std::uniform_real_distribution<double> angle(0.0, 6.3), size(-3.0, 3.0);
    for (int i = 0; i < 1000; ++i) {
        const double c = std::cos(angle(random)), s = std::sin(angle(random)),
                     one = std::pow(10.0, size(random));
        const double other = one * std::pow(10.0, size(random) / 3.0), direction = angle(random);
        const V k(one * c * c + other * s * s, (one - other) * c * s, one * s * s + other * c * c);
        const glm::dvec2 slip(std::cos(direction), std::sin(direction));
        const glm::dvec2 holding(k.x * slip.x + k.y * slip.y, k.y * slip.x + k.z * slip.y);
        const double most = glm::length(holding) * std::pow(10.0, size(random) / 2.0);
        const cpu::Friction<double> found = cpu::friction_on<double>({slip, k, most, {0.0, 0.0}}, 1.0);
        const glm::dvec2 back = slip - found.yielding * found.force;
        const glm::dvec2 force(k.x * back.x + k.y * back.y, k.y * back.x + k.z * back.y);
        const double tolerance = 1e-3 * glm::length(found.force);
        EXPECT_LT(glm::length(force - found.force), tolerance);
        EXPECT_LE(glm::length(found.force), most * (1.0 + 1e-12));
        EXPECT_EQ(found.yielding > 0.0, glm::length(holding) > most);
    }
}

// Of nodes that hardly press, far slips and all stiffnesses that meshes of any size have.
TEST(FrictionOnASlip, IsFiniteAtAllScales) {
    std::mt19937 random(7);
    std::uniform_real_distribution<float> unit(-1.0f, 1.0f), size(-12.0f, 9.0f);
    const auto scale = [&] { return std::pow(10.0f, size(random)); };
    for (int i = 0; i < 100'000; ++i) {
        const float stiffness = scale(), way = scale(), coefficient = std::pow(10.0f, 3.0f * unit(random));
        std::array<glm::vec3, 3> rows;  // of a root of the Hessian, without its scale
        for (glm::vec3& row : rows) row = {unit(random), unit(random), unit(random)};
        const auto entry = [&](int a, int b) {
            float sum = a == b ? 1e-3f : 0.0f;
            for (const glm::vec3& row : rows) sum += row[a] * row[b];
            return stiffness * sum;
        };
        const cpu::Friction<float> found =
            cpu::friction_on<float>({.way = way * test::draw_vector<glm::vec2>(unit, random),
                                     .stiffness = {entry(0, 0), entry(0, 1), entry(1, 1)},
                                     .pressing = scale(),
                                     .coupling = {entry(0, 2), entry(1, 2)}},
                                    coefficient);
        ASSERT_TRUE(std::isfinite(glm::length(found.back)) && std::isfinite(found.pressing) &&
                    std::isfinite(found.force.x + found.force.y))
            << i;
    }
}

// `along` is the slope of the normal force by the depth that a Newton step ends at.
TEST_F(PushOutside, KnowsHowItsForceFalls) {
    const auto hessian = stiffness();
    const V start = along_plane();
    const auto pressing_at = [&](double depth) {
        V at = start - depth * kNormal;
        return glm::dot(push(0.0, start, hessian, at).force, kNormal);
    };
    V at = start - kDepth * kNormal;
    const double slope = (pressing_at(kDepth + 1e-4) - pressing_at(kDepth - 1e-4)) / 2e-4;
    EXPECT_NEAR(push(0.0, start, hessian, at).along, slope, 1e-5 * slope);
}

TEST_F(PushOutside, LeavesNodesOutsideWhereTheyAre) {
    V at = 0.01 * kNormal;
    Contact contact;
    EXPECT_FALSE(cpu::push_outside(make_plane(0.5), V(0), stiffness(), at, contact));
    EXPECT_EQ(at, 0.01 * kNormal);
    EXPECT_EQ(contact.force, V(0));
}

}  // namespace
}  // namespace gelatin
