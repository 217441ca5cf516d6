#include "cpu/descent/rigid_motion.h"

#include <gtest/gtest.h>

#include <random>

namespace gelatin {
namespace {

using V3 = cpu::Vec3<double>;
using V4 = cpu::Vec4<double>;

std::vector<V4> make_nodes(const V3& extent) {
    std::mt19937 random(3);
    std::uniform_real_distribution<double> unit(-1.0, 1.0);
    std::vector<V4> nodes;
    for (int i = 0; i < 50; ++i) {
        const double x = unit(random), y = unit(random), z = unit(random);
        nodes.emplace_back(extent * V3(x, y, z) + V3(10, 20, 30), 2.0 + unit(random));
    }
    return nodes;
}

// What takes free nodes nearest to their targets.
cpu::RigidMotion nearest_motion(const std::vector<V4>& nodes, const std::vector<V3>& targets) {
    const V3 origin(nodes[0]);
    cpu::RigidStep step;
    for (std::size_t n = 0; n < nodes.size(); ++n) {
        const double mass = 1.0 / nodes[n].w;
        step.add(V3(nodes[n]) - origin, mass, mass * (targets[n] - V3(nodes[n])));
    }
    return step.solve(origin);
}

V3 sum_of_momenta(const std::vector<V4>& nodes, const std::vector<V3>& targets) {
    V3 sum(0);
    for (std::size_t n = 0; n < nodes.size(); ++n) sum += (targets[n] - V3(nodes[n])) / nodes[n].w;
    return sum;
}

TEST(RigidMotion, FindsAMotionThatWasMade) {
    const std::vector<V4> nodes = make_nodes(V3(1));
    const cpu::RigidMotion made{V3(10, 20, 30), V3(0.1, -0.2, 0.3),
                                cpu::cayley_rotation(1e-4 * glm::normalize(V3(1, 2, 3)))};
    std::vector<V3> targets;
    for (const V4& p : nodes) targets.push_back(made.move(V3(p)));
    const cpu::RigidMotion found = nearest_motion(nodes, targets);
    // The rotation is off by its second order, and by a millionth for what keeps thin bodies from rotating
    // wildly.
    for (const V4& p : nodes) EXPECT_LT(glm::distance(found.move(V3(p)), made.move(V3(p))), 3e-8);
}

TEST(RigidMotion, CayleysRotationIsARotation) {
    for (const double size : {1e-6, 0.1, 1.0, 100.0}) {
        const V3 w = size * glm::normalize(V3(3, -1, 2));
        const glm::dmat3 rotation = cpu::cayley_rotation(w);
        const glm::dmat3 error = glm::transpose(rotation) * rotation - glm::dmat3(1.0);
        for (int k = 0; k < 3; ++k) EXPECT_LT(glm::length(error[k]), 1e-14);
        EXPECT_LT(glm::distance(rotation * w, w), 1e-14 * size);
        const V3 across = glm::normalize(glm::cross(w, V3(1, 0, 0)));
        EXPECT_NEAR(glm::dot(rotation * across, across), std::cos(2.0 * std::atan(size / 2.0)), 1e-14);
    }
}

TEST(RigidMotion, GivesNodesTheMomentumOfTheirTargets) {
    std::vector<V4> nodes = make_nodes(V3(1));
    std::vector<V3> targets;
    for (const V4& p : make_nodes(V3(2, 1, 1))) targets.push_back(V3(p) + V3(0, 0.1, 0));
    const cpu::RigidMotion motion = nearest_motion(nodes, targets);
    for (V4& p : nodes) p = V4(motion.move(V3(p)), p.w);
    EXPECT_LT(glm::length(sum_of_momenta(nodes, targets)), 1e-11);
}

// On a floor that is all but rigid a body goes along it, and turns about its normal, as if it had no weight.
TEST(RigidMotion, SlidesAlongASurface) {
    const std::vector<V4> nodes = make_nodes(V3(1));
    const V3 origin(nodes[0]), normal(0, 1, 0);
    const cpu::RigidMotion made{V3(10, 20, 30), V3(0.1, 0, 0.3), cpu::cayley_rotation(V3(0, 1e-4, 0))};
    cpu::RigidStep step;
    for (const V4& p : nodes) {
        const double mass = 1.0 / p.w;
        const V3 force = mass * (made.move(V3(p)) - V3(p));
        step.add(V3(p) - origin, mass, force + V3(0, -9.81 * mass, 0));
        step.add(V3(p) - origin, {normal, 0.0, V3(0), 1e12 * mass, 0.0});
    }
    const cpu::RigidMotion found = step.solve(origin);
    for (const V4& p : nodes) EXPECT_LT(glm::distance(found.move(V3(p)), made.move(V3(p))), 3e-8);
}

// Nodes have found ten times the force that is needed to hold the body up, and of friction as much as goes
// with it. What is left of it goes with the force that is needed.
TEST(RigidMotion, SlidesWithTheFrictionOfWhatHoldsIt) {
    const std::vector<V4> nodes = make_nodes(V3(1));
    const V3 origin(nodes[0]);
    const double step = 1e-2, gravity = 9.81, friction = 0.2, pull = 5.0;
    cpu::RigidStep body;
    double inertia = 0.0, friction_stiffness = 0.0;
    for (const V4& p : nodes) {
        const double mass = 1.0 / p.w, pressing = 10.0 * mass * gravity;
        body.add(V3(p) - origin, mass / (step * step), mass * V3(pull, -gravity, 0));
        body.add(V3(p) - origin,
                 {V3(0, 1, 0), pressing, V3(-friction * pressing, 0, 0), 1e9 * mass, 10.0 * mass});
        inertia += mass / (step * step);
        friction_stiffness += 10.0 * mass;
    }
    const cpu::RigidMotion found = body.solve(origin);
    const double force = (pull - friction * gravity) * inertia * step * step;
    const double expected = force / (inertia + 0.1 * friction_stiffness);
    EXPECT_NEAR(found.translation.x, expected, 1e-3 * expected);
    EXPECT_LT(glm::length(found.rotation[0] - V3(1, 0, 0)), 1e-2 * expected);
}

// Held by friction it stays, but for what that gives way.
TEST(RigidMotion, StaysWhereFrictionHolds) {
    const std::vector<V4> nodes = make_nodes(V3(1));
    const V3 origin(nodes[0]);
    cpu::RigidStep step;
    for (const V4& p : nodes) {
        step.add(V3(p) - origin, 1.0 / p.w, V3(1, 2, 3));
        step.add(V3(p) - origin, {V3(0, 1, 0), 0.0, V3(0), 1e9, 1e9});
    }
    const cpu::RigidMotion found = step.solve(origin);
    for (const V4& p : nodes) EXPECT_LT(glm::distance(found.move(V3(p)), V3(p)), 1e-8);
}

TEST(RigidMotion, OfWhatHasNoInertiaIsFinite) {
    for (const V3& extent : {V3(1, 0, 0), V3(0)}) {
        const std::vector<V4> nodes = make_nodes(extent);
        std::vector<V3> targets;
        for (const V4& p : make_nodes(V3(1))) targets.push_back(V3(p));
        const cpu::RigidMotion motion = nearest_motion(nodes, targets);
        for (const V4& p : nodes) EXPECT_LT(glm::distance(motion.move(V3(p)), V3(p)), 3.0);
    }
}

}  // namespace
}  // namespace gelatin
