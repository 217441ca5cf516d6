#include "cpu/collision/respond.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <glm/geometric.hpp>

#include "support/crowd.h"
#include "support/test_models.h"

namespace gelatin {
namespace {

constexpr double kResponseStep = 1e-3;  // [s]

Body make_cube(glm::dvec3 place, glm::dvec3 velocity) {
    Body body = test::make_body(test::make_block({1, 1, 1}, {1, 1, 1}));
    for (glm::dvec3& p : body.mesh.positions) p += place;
    body.velocity = velocity;
    return body;
}

// A cube on top of another one twice as heavy, a little inside it: they touch all over one side.
Model make_stack(glm::dvec3 upper_velocity, glm::dvec3 lower_velocity) {
    Body lower = make_cube({0, 0, 0}, lower_velocity);
    lower.material.density = 2000.0;
    return pack_bodies({lower, make_cube({0, 0.99, 0}, upper_velocity)}, {}, {0.0, -9.81, 0.0});
}

bool moved(const Model& model, const cpu::Nodes<double>& after, std::uint32_t n) {
    return glm::dvec3(after.velocities[n]) != glm::dvec3(model.velocities[n]);
}

glm::dvec3 momentum_of(const Model& model, const std::vector<glm::dvec4>& velocities) {
    glm::dvec3 sum(0.0);
    for (std::size_t n = 0; n < velocities.size(); ++n) {
        const auto inverse_mass = static_cast<double>(model.positions[n].w);
        if (inverse_mass > 0.0) sum += glm::dvec3(velocities[n]) / inverse_mass;
    }
    return sum;
}

template <class Real>
double momentum_error(const Model& model, const CollisionSettings& settings) {
    const cpu::Nodes<Real> after = test::respond_on_cpu<Real>(model, settings, kResponseStep);
    const glm::dvec3 change = momentum_of(model, {after.velocities.begin(), after.velocities.end()}) -
                              momentum_of(model, {model.velocities.begin(), model.velocities.end()});
    double scale = 0.0;
    for (std::size_t n = 0; n < model.positions.size(); ++n) {
        scale += glm::length(glm::dvec3(model.velocities[n])) / static_cast<double>(model.positions[n].w);
    }
    return glm::length(change) / scale;
}

TEST(Respond, KeepsTheMomentumOfACrowd) {
    Model model = test::make_crowd(40, 3);
    for (std::size_t n = 0; n < model.positions.size(); ++n) model.positions[n].w = 1.0f / model.masses[n];
    for (const double friction : {0.0, 0.5}) {
        const CollisionSettings settings{.friction = friction, .restitution = 0.4};
        EXPECT_LT(momentum_error<double>(model, settings), 1e-15);
        EXPECT_LT(momentum_error<float>(model, settings), 1e-6);
    }
}

// All corners of a patch move alike here, so each leaves the contact by Newton's law of restitution.
TEST(Respond, ReboundsByTheRestitution) {
    const double up = 3.0, down = -2.0;  // [m/s]
    const Model model = make_stack({0, down, 0}, {0, up, 0});
    const cpu::Nodes<double> after =
        test::respond_on_cpu<double>(model, {.friction = 0.0, .restitution = 0.6}, kResponseStep);
    int lower = 0, upper = 0;
    double lower_speed = 0.0, upper_speed = 0.0;
    for (std::uint32_t n = 0; n < model.node_count(); ++n) {
        if (!moved(model, after, n)) continue;
        const bool is_upper = n >= model.objects[1].nodes.first;
        (is_upper ? upper_speed : lower_speed) = after.velocities[n].y;
        ++(is_upper ? upper : lower);
    }
    EXPECT_GE(lower, 4);
    EXPECT_GE(upper, 4);
    EXPECT_NEAR(upper_speed - lower_speed, 0.6 * (up - down), 1e-6);
}

TEST(Respond, SlowerThanGravityNothingBounces) {
    const Model model = make_stack({0, -1.9 * 9.81 * kResponseStep, 0}, {0, 0, 0});
    const cpu::Nodes<double> after =
        test::respond_on_cpu<double>(model, {.friction = 0.0, .restitution = 1.0}, kResponseStep);
    for (std::uint32_t n = 0; n < model.node_count(); ++n) {
        EXPECT_LE(after.velocities[n].y, 0.0) << "what moved has the velocity they have in common";
    }
}

TEST(Respond, LeavesAloneWhatParts) {
    const Model model = make_stack({0, 1, 0}, {0, -1, 0});
    const cpu::Nodes<double> after = test::respond_on_cpu<double>(model, {}, kResponseStep);
    for (std::uint32_t n = 0; n < model.node_count(); ++n) {
        EXPECT_FALSE(moved(model, after, n));
        EXPECT_EQ(glm::vec3(after.positions[n]), glm::vec3(model.positions[n]));
    }
}

TEST(Respond, BringsNodesBackAlongTheNormalAlone) {
    const Model model = make_stack({1, -3, 0}, {1, 3, 0});
    const auto before = test::positions_before(model, kResponseStep);
    const cpu::Nodes<double> after =
        test::respond_on_cpu<double>(model, {.friction = 0.0, .restitution = 0.0}, kResponseStep);
    double common = 0.0;  // the velocity of the contact: what both sides' corners have afterwards
    for (std::uint32_t n = 0; n < model.node_count(); ++n) {
        if (moved(model, after, n)) common = after.velocities[n].y;
    }
    EXPECT_GT(common, 0.0) << "the heavier one came from below";
    for (std::uint32_t n = 0; n < model.node_count(); ++n) {
        const double x = static_cast<double>(before[n].x) + kResponseStep;
        EXPECT_NEAR(after.positions[n].x, x, 1e-6) << "slid on";
        if (!moved(model, after, n)) continue;
        EXPECT_NEAR(after.positions[n].y, static_cast<double>(before[n].y) + kResponseStep * common, 1e-6);
    }
}

// Tangential impulse over normal impulse is Coulomb's coefficient while it slides, and less where it sticks.
TEST(Respond, SlowsByFriction) {
    const double slide = 2.0, fall = 1.0;  // [m/s]
    const Model model = make_stack({slide, -fall, 0}, {0, 0, 0});
    for (const double friction : {0.1, 0.3, 50.0}) {
        const cpu::Nodes<double> after =
            test::respond_on_cpu<double>(model, {.friction = friction, .restitution = 0.0}, kResponseStep);
        glm::dvec3 impulse(0.0);
        glm::dvec3 upper_velocity(0.0), lower_velocity(0.0);
        for (std::uint32_t n = 0; n < model.node_count(); ++n) {
            if (!moved(model, after, n)) continue;
            const bool is_upper = n >= model.objects[1].nodes.first;
            (is_upper ? upper_velocity : lower_velocity) = glm::dvec3(after.velocities[n]);
            if (is_upper) {
                impulse += (glm::dvec3(after.velocities[n]) - glm::dvec3(model.velocities[n])) /
                           static_cast<double>(model.positions[n].w);
            }
        }
        if (friction < 1.0) {
            EXPECT_NEAR(-impulse.x / impulse.y, friction, 1e-6);
        } else {
            EXPECT_NEAR(upper_velocity.x, lower_velocity.x, 1e-6) << "it sticks";
        }
    }
}

TEST(Respond, APinnedBodyIsAWall) {
    Body wall = make_cube({0, 0, 0}, {0, 0, 0});
    wall.pins = {BoxRegion{{-9, -9, -9}, {9, 9, 9}}};
    const Model model = pack_bodies({wall, make_cube({0, 0.99, 0}, {0, -4, 0})}, {}, {0.0, -9.81, 0.0});
    const cpu::Nodes<double> after =
        test::respond_on_cpu<double>(model, {.friction = 0.0, .restitution = 0.5}, kResponseStep);
    int bounced = 0;
    for (std::uint32_t n = 0; n < model.node_count(); ++n) {
        if (n < model.objects[1].nodes.first) {
            EXPECT_EQ(glm::vec3(after.positions[n]), glm::vec3(model.positions[n]));
            EXPECT_FALSE(moved(model, after, n));
        } else if (moved(model, after, n)) {
            EXPECT_NEAR(after.velocities[n].y, 2.0, 1e-6);
            ++bounced;
        }
    }
    EXPECT_GE(bounced, 4);
}

// A wall that a handle moves: what meets it leaves with the restitution as the wall sees it, whoever comes.
TEST(Respond, AMovingHandlePushes) {
    Body wall = make_cube({0, 0, 0}, {0, 0, 0});
    wall.pins = {BoxRegion{{-9, -9, -9}, {9, 9, 9}}};
    Model model = pack_bodies({wall, make_cube({0, 0.99, 0}, {0, 0, 0})}, {}, {0.0, -9.81, 0.0});
    test::move_pinned(model, {0.0f, 3.0f, 0.0f});
    const cpu::Nodes<double> after =
        test::respond_on_cpu<double>(model, {.friction = 0.0, .restitution = 0.5}, kResponseStep);
    int pushed = 0;
    for (std::uint32_t n = model.objects[1].nodes.first; n < model.node_count(); ++n) {
        if (!moved(model, after, n)) continue;
        EXPECT_NEAR(after.velocities[n].y, 4.5, 1e-6);
        ++pushed;
    }
    EXPECT_GE(pushed, 4);
}

// The laws are the same in every inertial frame.
TEST(Respond, DoesNotDependOnTheFrame) {
    const glm::vec3 common(3.0f, -1.0f, 2.0f);
    Model still = test::make_crowd(12, 6);
    for (std::size_t n = 0; n < still.positions.size(); ++n) still.positions[n].w = 1.0f / still.masses[n];
    Model moving = still;
    for (glm::vec4& v : moving.velocities) v += glm::vec4(common, 0.0f);
    const CollisionSettings settings{.friction = 0.3, .restitution = 0.5};
    const cpu::Nodes<double> one = test::respond_on_cpu<double>(still, settings, kResponseStep);
    const cpu::Nodes<double> two = test::respond_on_cpu<double>(moving, settings, kResponseStep);
    for (std::uint32_t n = 0; n < still.node_count(); ++n) {
        EXPECT_LT(
            glm::distance(glm::dvec3(one.velocities[n]) + glm::dvec3(common), glm::dvec3(two.velocities[n])),
            1e-5);
        EXPECT_LT(glm::distance(glm::dvec3(one.positions[n]), glm::dvec3(two.positions[n])), 1e-6);
    }
}

TEST(Respond, IsTheSameForAnyNumberOfThreads) {
    const Model model = test::make_crowd(60, 5);
    const cpu::Nodes<float> parallel = test::respond_on_cpu<float>(model, {}, kResponseStep);
    const tbb::global_control one_thread(tbb::global_control::max_allowed_parallelism, 1);
    const cpu::Nodes<float> serial = test::respond_on_cpu<float>(model, {}, kResponseStep);
    EXPECT_EQ(parallel.positions, serial.positions);
    EXPECT_EQ(parallel.velocities, serial.velocities);
}

}  // namespace
}  // namespace gelatin
