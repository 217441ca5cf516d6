#include "cpu/implicit/rest_watch.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <glm/geometric.hpp>
#include <memory>
#include <utility>
#include <vector>

#include "cpu/make_solver.h"
#include "support/contact_scenes.h"
#include "support/test_models.h"

namespace gelatin {
namespace {

using test::kFrame;

// Of soft bodies above a plane, which sleep if they may.
class Sleeper {
public:
    explicit Sleeper(std::shared_ptr<const Model> model, bool sleeps = true)
        : model_(std::move(model)),
          solver_(cpu::make_solver<float>(
              model_, SolverKind::implicit, ForceMethod::fused,
              CollisionSettings{.response = CollisionResponse::contact, .restitution = 0.0},
              ImplicitSettings{.divides_steps = true, .sleeps = sleeps})) {}

    void advance(int frames) {
        for (int k = 0; k < frames; ++k) test::advance(*solver_, *model_, frame_++);
    }
    cpu::CpuSolver<float>& solver() { return *solver_; }
    const Model& model() const { return *model_; }
    const std::vector<cpu::Vec4<float>>& positions() const { return solver_->nodes().positions; }
    float fastest_of(std::size_t object) const {
        float most = 0.0f;
        const Range& nodes = model_->objects[object].nodes;
        for (std::uint32_t n = nodes.first; n < nodes.end(); ++n)
            most = std::max(most, glm::length(glm::vec3(solver_->nodes().velocities[n])));
        return most;
    }
    float fastest() const {
        float most = 0.0f;
        for (const auto& velocity : solver_->nodes().velocities)
            most = std::max(most, glm::length(glm::vec3(velocity)));
        return most;
    }
    // Nothing moves, to the last bit; without sleep speeds are small, but not zero.
    bool is_asleep() {
        const std::vector<cpu::Vec4<float>> before = positions();
        advance(1);
        return fastest() == 0.0f && positions() == before;
    }
    glm::dvec3 center(std::size_t object) const {
        const Range& nodes = model_->objects[object].nodes;
        glm::dvec3 sum(0.0);
        for (std::uint32_t n = nodes.first; n < nodes.end(); ++n) sum += glm::dvec3(positions()[n]);
        return sum / static_cast<double>(nodes.count);
    }

private:
    std::shared_ptr<const Model> model_;
    std::unique_ptr<cpu::CpuSolver<float>> solver_;
    int frame_ = 0;
};

const glm::dvec3 kFalling{0, -9.81, 0};

ColliderDescription floor() {
    ColliderDescription description;
    description.shape = PlaneCollider{};
    return description;
}

// Two blocks of 27 kg, one on the other.
std::shared_ptr<const Model> make_stack() {
    return test::make_blocks({{.place = {0, 0.002, 0}}, {.place = {0.01, 0.33, 0.02}}}, kFalling, {floor()});
}

constexpr int kUntilRest = 900;  // frames

TEST(RestWatch, BodiesAtRestSleepAndAreHeldAsBefore) {
    Sleeper scene(make_stack());
    scene.advance(kUntilRest);
    ASSERT_TRUE(scene.is_asleep());
    const ContactForces forces = scene.solver().contact_forces();
    glm::dvec3 sum(0.0);
    for (const glm::dvec3& force : forces.normal) sum += force;
    EXPECT_NEAR(sum.y, 2.0 * 27.0 * 9.81, 0.01 * 2.0 * 27.0 * 9.81);
}

TEST(RestWatchHeavy, WithoutItBodiesAtRestAreSimulated) {
    Sleeper scene(make_stack(), false);
    scene.advance(kUntilRest);
    EXPECT_LT(scene.fastest(), 1e-4f);
    EXPECT_FALSE(scene.is_asleep());
}

// The feet of jittered blocks, which are stiffer one way than another, are held in all directions.
TEST(RestWatch, BlocksDoNotCreep) {
    const auto model =
        test::make_blocks({{.place = {0, 0.002, 0}}, {.place = {1, 0.002, 0}}}, kFalling, {floor()});
    Sleeper scene(model, false);
    scene.advance(600);
    const std::vector<cpu::Vec4<float>> before = scene.positions();
    scene.advance(30);
    float most = 0.0f;
    for (std::size_t n = 0; n < before.size(); ++n)
        most = std::max(most, glm::distance(glm::vec3(before[n]), glm::vec3(scene.positions()[n])));
    EXPECT_LT(most, 2e-6f);
}

// The upper blocks come from far: the lower ones rest long before. One falls beside them, and one on one of
// them.
TEST(RestWatch, BodiesSleepByIsland) {
    const auto model = test::make_blocks({{.place = {0, 0.002, 0}, .youngs_modulus = 1e6},
                                          {.place = {3, 0.002, 0}, .youngs_modulus = 1e6},
                                          {.place = {5, 12, 0}, .youngs_modulus = 1e6},
                                          {.place = {0.01, 15, 0}, .youngs_modulus = 1e6}},
                                         kFalling, {floor()});
    Sleeper scene(model);
    constexpr int kAsleep = 90, kLanded = 150, kHit = 120;  // frames; sqrt(2 15 / g) = 105 frames
    scene.advance(kAsleep);
    const ContactForces forces = scene.solver().contact_forces();
    ASSERT_EQ(forces.between.size(), 2u) << "of what sleeps they stay";
    for (const auto& force : forces.between) EXPECT_NEAR(force.normal.y, 27.0 * 9.81, 0.01 * 27.0 * 9.81);
    EXPECT_EQ(scene.fastest_of(0), 0.0f);
    EXPECT_EQ(scene.fastest_of(1), 0.0f);
    EXPECT_GT(scene.fastest_of(2), 10.0f);
    const std::vector<cpu::Vec4<float>> before = scene.positions();
    scene.advance(kHit - kAsleep);
    EXPECT_GT(scene.fastest_of(0), 0.01f) << "it was hit";
    scene.advance(kLanded - kHit);
    const Range& nodes = model->objects[1].nodes;
    for (std::uint32_t n = nodes.first; n < nodes.end(); ++n) EXPECT_EQ(scene.positions()[n], before[n]);
    for (std::size_t n = 0; n < before.size(); ++n) EXPECT_EQ(scene.positions()[n].w, before[n].w);
}

// As if it had been awake: it is let go before anything presses it.
TEST(RestWatch, WhatWakesTakesPartInTheImpact) {
    const auto model = test::make_blocks({{}, {.place = {1.5, 0.05, 0.02}, .velocity = {-1.0, 0, 0}}});
    Sleeper scene(model);
    const auto momentum = [&] { return test::sum_bodies(*model, scene.solver().nodes()).momentum; };
    const glm::dvec3 start = momentum();
    scene.advance(60);
    EXPECT_EQ(scene.fastest_of(0), 0.0f);
    scene.advance(60);
    EXPECT_GT(glm::distance(scene.center(0), Sleeper(model).center(0)), 0.05);
    EXPECT_LT(glm::length(momentum() - start), 1e-5 * glm::length(start));
}

TEST(RestWatch, SlowMotionIsNoRest) {
    const auto model =
        test::make_blocks({{.velocity = {1e-3, 0, 0}}, {.place = {2, 0, 0}, .velocity = {1e-3, 0, 0}}});
    Sleeper scene(model);
    const double start = scene.center(0).x;
    scene.advance(180);
    EXPECT_NEAR(scene.center(0).x, start + 3e-3, 5e-6);
}

TEST(RestWatch, AHandWakes) {
    const auto model =
        test::make_blocks({{.place = {0, 0.002, 0}}, {.place = {1, 0.002, 0}}}, kFalling, {floor()});
    Sleeper scene(model);
    scene.advance(kUntilRest);
    ASSERT_TRUE(scene.is_asleep());
    const glm::dvec3 center = scene.center(0);
    Pull pull;
    const Range& nodes = model->objects[0].nodes;
    for (std::uint32_t n = nodes.first; n < nodes.end(); ++n)
        pull.nodes.push_back(Pull::Node{n, glm::vec3(scene.positions()[n]) - glm::vec3(center), 400.0f});
    pull.target = center + glm::dvec3(0, 0.05, 0);
    scene.solver().set_pulls({pull});
    scene.advance(60);
    EXPECT_GT(scene.center(0).y, center.y + 0.03);
    scene.solver().set_pulls({});  // it falls, and rests again
    scene.advance(kUntilRest);
    EXPECT_TRUE(scene.is_asleep());
    EXPECT_NEAR(scene.center(0).y, center.y, 1e-3);
}

TEST(RestWatch, NodesSetFromOutsideWake) {
    Sleeper scene(make_stack());
    scene.advance(kUntilRest);
    ASSERT_TRUE(scene.is_asleep());
    State state = scene.solver().read_state();
    for (glm::vec4& velocity : state.velocities) velocity.y = 3.0f;
    scene.solver().write_state(state);
    const double height = scene.center(1).y;
    scene.advance(10);
    EXPECT_GT(scene.center(1).y, height + 0.3);
}

// A wall that has stood still comes and pushes a block, at a speed that no single step shows.
TEST(RestWatchHeavy, CollidersThatBeginToMoveWake) {
    ColliderDescription wall;
    wall.shape = BoxShape{.size = {0.1, 1.0, 1.0}};
    wall.position = {-0.06, 0.51, 0.15};
    wall.keyframes = {{.time = 0.0}, {.time = 16.0}, {.time = 46.0, .move = {0.03, 0, 0}}};
    const auto model =
        test::make_blocks({{.place = {0, 0.002, 0}, .friction = 0.1}}, kFalling, {floor(), wall});
    Sleeper scene(model);
    scene.advance(kUntilRest);
    ASSERT_TRUE(scene.is_asleep());
    const double before = scene.center(0).x;
    scene.advance(2760 - kUntilRest - 1);
    EXPECT_GT(scene.center(0).x, before + 0.01);
    Sleeper awake(model, false);
    awake.advance(2760);
    EXPECT_NEAR(scene.center(0).x, awake.center(0).x, 5e-4);
}

}  // namespace
}  // namespace gelatin
