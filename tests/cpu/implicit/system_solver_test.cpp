#include "cpu/implicit/system_solver.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

#include "model/assembly/build_model.h"
#include "support/contact_scenes.h"
#include "support/overlaps.h"
#include "support/random_maker.h"
#include "support/test_models.h"

namespace gelatin {
namespace {

using test::Block;
using test::BodySums;
using test::kFrame;
using test::make_blocks;
using test::sum_bodies;

template <class Real>
cpu::SystemSolver<Real> make_system_solver(const std::shared_ptr<const Model>& model, double friction = 0.4,
                                           bool divides_steps = true, int iterations = 10) {
    return cpu::SystemSolver<Real>(
        model,
        CollisionSettings{
            .response = CollisionResponse::contact, .self_collision = true, .friction = friction},
        ImplicitSettings{.iterations = iterations, .divides_steps = divides_steps});
}

std::shared_ptr<const Model> meeting_blocks(double speed, double youngs_modulus,
                                            MaterialModel kind = MaterialModel::mass_spring) {
    return make_blocks({{.velocity = {0.5 * speed, 0, 0}, .youngs_modulus = youngs_modulus, .model = kind},
                        {.place = {0.34, 0.1, 0.05},
                         .velocity = {-0.5 * speed, 0, 0},
                         .youngs_modulus = youngs_modulus,
                         .model = kind}});
}

void fuzz_system_solver(unsigned first_seed, unsigned count) {
    for (unsigned seed = first_seed; seed < first_seed + count; ++seed) {
        test::RandomMaker random(seed);
        const auto model = make_blocks(test::violent_blocks(random, 5), {0, -9.81, 0});
        cpu::SystemSolver<float> solver = make_system_solver<float>(model);
        ASSERT_TRUE(test::stays_apart(solver, *model, 20)) << "scene " << seed;
    }
}

TEST(SystemSolver, NothingPassesThroughAnything) {
    fuzz_system_solver(1, 12);
}

TEST(SystemSolverLong, NothingPassesThroughAnything) {
    fuzz_system_solver(100, 300);
}

TEST(SystemSolver, GivesTheSameBitsForAnyNumberOfThreads) {
    const auto run = [](std::size_t threads) {
        const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
        const auto model = meeting_blocks(6.0, 1e5);
        cpu::SystemSolver<float> solver = make_system_solver<float>(model);
        for (int frame = 0; frame < 10; ++frame) solver.advance({kFrame});
        return solver.nodes().positions;
    };
    EXPECT_EQ(run(1), run(2));
}

TEST(SystemSolver, StartsAgain) {
    const auto model = meeting_blocks(6.0, 1e5);
    cpu::SystemSolver<float> solver = make_system_solver<float>(model);
    const State start = solver.read_state();
    const auto advance = [&] {
        for (int frame = 0; frame < 3; ++frame) solver.advance({kFrame});
        return solver.nodes().positions;
    };
    const std::vector<glm::vec4> first = advance();
    ASSERT_FALSE(solver.contact_forces().between.empty());  // they press each other
    solver.write_state(start);
    EXPECT_EQ(advance(), first);
}

TEST(SystemSolver, KeepsMomentum) {
    for (const MaterialModel kind : {MaterialModel::mass_spring, MaterialModel::neo_hookean}) {
        const auto model = meeting_blocks(6.0, 1e5, kind);
        cpu::SystemSolver<double> solver = make_system_solver<double>(model);
        const BodySums before = sum_bodies(*model, solver.nodes());
        for (int frame = 0; frame < 20; ++frame) solver.advance({kFrame});
        const BodySums after = sum_bodies(*model, solver.nodes());
        EXPECT_LT(after.kinetic, 0.9 * before.kinetic);  // they have met
        EXPECT_LT(glm::length(after.momentum - before.momentum), 1e-11);
    }
}

// How far a solver that goes on from a state is from one that was not stopped [m].
float goes_astray(bool is_pinned, bool has_memory, bool has_earlier_velocities) {
    Block block{.velocity = {1, 2, 0}};
    if (is_pinned) block.pins = {HalfSpaceRegion{{1, 0, 0}, 0.05}};
    auto moving = std::make_shared<Model>(*make_blocks({block}));
    for (std::uint32_t n = 0; n < moving->node_count(); ++n)
        if (moving->positions[n].w != 0.0f)
            moving->velocities[n].x += 3.0f * moving->positions[n].y * moving->positions[n].y;
    const std::shared_ptr<const Model> model = moving;
    cpu::SystemSolver<float> solver = make_system_solver<float>(model),
                             other = make_system_solver<float>(model);
    for (int frame = 0; frame < 3; ++frame) solver.advance({kFrame});
    State state = solver.read_state();
    if (has_memory) state.memory = solver.memory();
    if (!has_earlier_velocities) state.earlier_velocities.clear();
    other.write_state(state);
    for (cpu::SystemSolver<float>* each : {&solver, &other})
        for (int frame = 0; frame < 3; ++frame) each->advance({kFrame});
    float farthest = 0.0f;
    for (std::size_t n = 0; n < model->node_count(); ++n)
        farthest = std::max(farthest, glm::distance(glm::vec3(solver.nodes().positions[n]),
                                                    glm::vec3(other.nodes().positions[n])));
    return farthest;
}

// With a memory exactly. Without, accelerations are those of the last step's change of velocities; without
// these implicit Euler's scheme comes first.
TEST(SystemSolver, GoesOnFromAState) {
    for (const bool is_pinned : {false, true}) {
        EXPECT_EQ(goes_astray(is_pinned, true, true), 0.0f) << is_pinned;
        EXPECT_LT(goes_astray(is_pinned, false, true), 0.3f * goes_astray(is_pinned, false, false))
            << is_pinned;
    }
}

// However short parts are, elements count: in each, they exert less than what a solve may leave.
TEST(SystemSolver, ShortStepsVibrateLikeLongerOnes) {
    auto moving = std::make_shared<Model>(*make_blocks({{.youngs_modulus = 3e4}}));
    for (std::uint32_t n = 0; n < moving->node_count(); ++n)
        moving->velocities[n].x = 3.0f * (moving->positions[n].y - 0.15f);
    const std::shared_ptr<const Model> model = moving;
    const auto places = [&](int substeps) {
        cpu::SystemSolver<double> solver = make_system_solver<double>(model, 0.4, false);
        for (int step = 0; step < 3 * substeps; ++step) solver.advance({kFrame / substeps});
        return solver.nodes().positions;
    };
    const std::vector<glm::dvec4> longer = places(32), shorter = places(512);
    double farthest = 0.0;
    for (std::size_t n = 0; n < longer.size(); ++n)
        farthest = std::max(farthest, glm::distance(glm::dvec3(longer[n]), glm::dvec3(shorter[n])));
    EXPECT_LT(farthest, 2e-4);
}

// A block flies on as its handle has taken it.
TEST(SystemSolver, FliesOnWhenItIsReleased) {
    Scene scene;
    scene.simulation.gravity = {0.0, 0.0, 0.0};
    Material& material = scene.materials.emplace_back();
    material.youngs_modulus = 1e6;
    ObjectDescription& block = scene.objects.emplace_back();
    material.name = block.material = "stiff";
    block.name = "block";
    block.shape = BoxShape{.size = glm::dvec3(0.2), .segments = glm::ivec3(3)};
    HandleDescription& handle = block.handles.emplace_back();
    handle.region = HalfSpaceRegion{{0.0, -1.0, 0.0}, -0.09};  // its top
    handle.keyframes = {{0.0}, {1.0, {0.4, 0.0, 0.0}}};
    handle.release = 0.5;
    const auto model = std::make_shared<const Model>(build_model(scene));
    cpu::SystemSolver<float> solver = make_system_solver<float>(model);
    for (int frame = 0; frame < 36; ++frame) test::advance(solver, *model, frame);
    // It vibrates as it is let go.
    EXPECT_NEAR(sum_bodies(*model, solver.nodes()).momentum.x / model->objects[0].mass, 0.4, 0.02);
}

// However the handle moved it last.
TEST(SystemSolver, KeepsItsMomentumWhenItIsReleased) {
    Body bar = test::make_body(test::make_block({8, 2, 2}, {0.4, 0.1, 0.1}));
    HandleDescription handle;
    handle.region = HalfSpaceRegion{{1.0, 0.0, 0.0}, 0.01};
    handle.keyframes = {{0.0}, {1.0, {0.4, 0.2, 0.0}, {0.0, 0.0, 90.0}}};
    handle.release = 0.2;
    bar.handles = {handle};
    const auto model = std::make_shared<const Model>(test::make_model(bar));
    cpu::SystemSolver<double> solver(model);
    int step = 0;
    const auto advance = [&] {
        for (int end = step + 40; step < end; ++step) test::advance(solver, *model, step, 0.005);
        glm::dvec3 momentum(0.0);  // of held nodes, too
        for (std::size_t n = 0; n < model->node_count(); ++n)
            momentum += static_cast<double>(model->masses[n]) * glm::dvec3(solver.nodes().velocities[n]);
        return momentum;
    };
    const glm::dvec3 before = advance();
    EXPECT_GT(glm::length(before), 0.2 * model->objects[0].mass);
    EXPECT_LT(glm::length(advance() - before), 1e-6 * glm::length(before));
}

// A pin holds the weight of a bar, and a handle that lifts one gives it its acceleration, also at 25 m/s.
TEST(SystemSolver, WhatHoldsABarExertsItsWeight) {
    constexpr double kGravity = 9.81, kStep = 1.0 / 60.0;
    for (const double acceleration : {0.0, 3.0}) {
        Body bar = test::make_body(test::make_block({12, 3, 3}, {0.5, 0.125, 0.125}));
        bar.material.youngs_modulus = 5e4;
        bar.material.damping = 5e-2;
        HandleDescription handle;
        handle.region = HalfSpaceRegion{{1, 0, 0}, 1e-6};
        for (int k = 0; k <= 500; ++k) {
            const double time = k * kStep;
            handle.keyframes.push_back({time, {0.0, 0.5 * acceleration * time * time, 0.0}});
        }
        bar.handles = {handle};
        const auto model = std::make_shared<const Model>(test::make_model(bar, {0, -kGravity, 0}));
        cpu::SystemSolver<float> solver(model);
        for (int step = 0; step < (acceleration == 0.0 ? 1500 : 500); ++step)
            test::advance(solver, *model, step, kStep);
        const double weight = model->objects[0].mass * (kGravity + acceleration);
        EXPECT_LT(glm::distance(solver.holding_forces().by_handle[0], {0, weight, 0}),
                  (acceleration == 0.0 ? 2e-4 : 8e-3) * weight)
            << acceleration;
    }
}

// What falls fast vibrates as what does not.
TEST(SystemSolver, VibrationsDoNotDependOnHowFastABodyFlies) {
    const auto after = [](double speed) {
        const auto model = make_blocks({{.velocity = {0, -speed, 0}, .youngs_modulus = 1e4}});
        auto stretched = std::make_shared<Model>(*model);
        for (std::size_t n = 0; n < stretched->node_count(); ++n)
            stretched->velocities[n].x = 3.0f * (stretched->positions[n].x - 0.15f);
        cpu::SystemSolver<double> solver(stretched);
        std::vector<double> elastic;
        for (int frame = 0; frame < 20; ++frame) {
            solver.advance({kFrame});
            elastic.push_back(sum_bodies(*stretched, solver.nodes()).elastic);
        }
        return elastic;
    };
    const std::vector<double> slow = after(0.0), fast = after(80.0);
    const double most = *std::max_element(slow.begin(), slow.end());
    EXPECT_GT(most, 0.1);
    for (std::size_t f = 0; f < slow.size(); ++f) EXPECT_NEAR(fast[f], slow[f], 0.02 * most) << f;
}

// Views of the nodes at a step's start stay as they are while it is made, in however many parts.
TEST(SystemSolver, KeepsTheNodesOfTheStart) {
    const auto model = make_blocks({{.velocity = {1, 0, 0}}});
    cpu::SystemSolver<float> solver = make_system_solver<float>(model);
    for (int frame = 0; frame < 3; ++frame) {
        const std::vector<glm::vec4>& start = solver.nodes().positions;
        const glm::vec4* const address = start.data();
        const std::vector<glm::vec4> kept = start;
        solver.advance({kFrame});
        EXPECT_NE(solver.nodes().positions.data(), address);
        EXPECT_TRUE(std::equal(kept.begin(), kept.end(), address));
    }
}

// With dampers of its own: without them a tower of cubes sways for minutes.
TEST(SystemSolver, ComesToRest) {
    std::vector<Block> blocks;
    for (int k = 0; k < 4; ++k)
        blocks.push_back({.place = {0.01 * (k % 2), 0.01 + 0.31 * k, 0}, .youngs_modulus = 1e6});
    ColliderDescription floor;
    floor.shape = PlaneCollider{};
    const auto model = make_blocks(blocks, {0, -9.81, 0}, {floor});
    cpu::SystemSolver<float> solver = make_system_solver<float>(model);
    for (int frame = 0; frame < 300; ++frame) solver.advance({kFrame});
    float fastest = 0.0f, highest = 0.0f;
    for (std::size_t n = 0; n < model->node_count(); ++n) {
        fastest = std::max(fastest, glm::length(glm::vec3(solver.nodes().velocities[n])));
        highest = std::max(highest, solver.nodes().positions[n].y);
    }
    EXPECT_LT(fastest, 1e-4f);
    EXPECT_NEAR(highest, 1.2f, 0.05f);
}

// Over edges of a mesh in all directions, at up to 5 m/s.
TEST(SystemSolver, SlidesOverEdges) {
    constexpr double kSlope = 0.2, kGravity = 9.81;
    const double angle = std::atan(kSlope);
    const Region everywhere = HalfSpaceRegion{{1.0, 0.0, 0.0}, 100.0};
    for (const double youngs_modulus : {3e4, 1e7}) {
        const auto model = make_blocks(
            {{.place = {-1.0, -0.1, -0.6},
              .cells = {100, 1, 10},
              .size = {16.0, 0.1, 1.6},
              .pins = {everywhere}},
             {.place = {-0.2, 0.012, 0}, .size = {0.3, 0.2, 0.3}, .youngs_modulus = youngs_modulus}},
            kGravity * glm::dvec3(std::sin(angle), -std::cos(angle), 0));
        cpu::SystemSolver<float> solver = make_system_solver<float>(model, 0.0);
        const auto speed = [&] {
            double momentum = 0.0;
            const Range& nodes = model->objects[1].nodes;
            for (std::uint32_t n = nodes.first; n < nodes.end(); ++n)
                momentum += static_cast<double>(model->masses[n] * solver.nodes().velocities[n].x);
            return momentum / model->objects[1].mass;
        };
        for (int frame = 0; frame < 90; ++frame) solver.advance({kFrame});
        const double before = speed();
        for (int frame = 0; frame < 60; ++frame) solver.advance({kFrame});
        EXPECT_NEAR(speed() - before, kGravity * std::sin(angle), 0.02) << youngs_modulus;
    }
}

// Dampers are for what rests: a ball that rolls goes on.
TEST(SystemSolver, RollsOn) {
    constexpr double kSpeed = 2.0, kRadius = 0.2;
    Scene scene;
    ObjectDescription& ball = scene.objects.emplace_back();
    ball.name = "ball";
    ball.shape = SphereShape{kRadius, 6};
    ball.position = {0.0, kRadius, 0.0};
    ball.velocity = {kSpeed, 0.0, 0.0};
    ball.spin = {0.0, 0.0, -glm::degrees(kSpeed / kRadius)};
    Material& material = scene.materials.emplace_back();
    material.name = ball.material = "stiff";
    material.youngs_modulus = 1e7;
    scene.colliders.emplace_back().shape = PlaneCollider{};
    const auto model = std::make_shared<const Model>(build_model(scene));
    cpu::SystemSolver<float> solver = make_system_solver<float>(model);
    const double before = sum_bodies(*model, solver.nodes()).kinetic;
    for (int frame = 0; frame < 60; ++frame) solver.advance({kFrame});
    EXPECT_GT(sum_bodies(*model, solver.nodes()).kinetic, 0.9 * before);
}

TEST(SystemSolver, StiffImpactsGainNoEnergy) {
    for (const double youngs_modulus : {1e7, 1e8, 1e9})
        for (const double speed : {1.0, 10.0}) {
            const auto model = meeting_blocks(speed, youngs_modulus);
            cpu::SystemSolver<float> solver = make_system_solver<float>(model);
            const double before = sum_bodies(*model, solver.nodes()).kinetic;
            for (int frame = 0; frame < 12; ++frame) {
                solver.advance({kFrame});
                const BodySums now = sum_bodies(*model, solver.nodes());
                ASSERT_LT(now.kinetic + now.elastic, 1.002 * before)
                    << youngs_modulus << " Pa, " << speed << " m/s, frame " << frame;
            }
        }
}

// Four steps a frame leave most of what many do: 0.86 here, where blocks meet with an edge, 0.96 where
// balls do.
TEST(SystemSolverHeavy, SoftImpactsAreLively) {
    const auto left = [](int substeps) {
        const auto model = meeting_blocks(3.0, 3e4);
        cpu::SystemSolver<float> solver = make_system_solver<float>(model, 0.4, false);
        for (int step = 0; step < 20 * substeps; ++step) solver.advance({kFrame / substeps});
        const BodySums sums = sum_bodies(*model, solver.nodes());
        return sums.kinetic + sums.elastic;
    };
    EXPECT_GT(left(4), 0.8 * left(32));
}

// A block that turns freely at 5 rad/s loses the energy of what stretches it at first, and no more.
TEST(SystemSolver, SpinsOn) {
    auto model = std::make_shared<Model>(*make_blocks({{.youngs_modulus = 1e6}}));
    const glm::dvec3 middle(0.15), spin(1.0, 5.0, 0.5);
    for (std::size_t n = 0; n < model->velocities.size(); ++n)
        model->velocities[n] =
            glm::vec4(glm::cross(spin, glm::dvec3(model->positions[n]) - middle), model->velocities[n].w);
    cpu::SystemSolver<float> solver = make_system_solver<float>(model, 0.4, false);
    const double before = sum_bodies(*model, solver.nodes()).kinetic;
    for (int step = 0; step < 5 * 240; ++step) solver.advance({1.0 / 240.0});
    const BodySums after = sum_bodies(*model, solver.nodes());
    EXPECT_GT(after.kinetic + after.elastic, 0.99 * before);
    EXPECT_LT(after.kinetic + after.elastic, 1.002 * before);
}

// By linear steps alone tets gain energy that turn fast, a little in each step and tenfold in half a
// minute.
TEST(SystemSolver, SpinsOnForLong) {
    Scene scene;
    scene.simulation.gravity = {0, 0, 0};
    Material& jelly = scene.materials.emplace_back();
    jelly.name = "jelly";
    jelly.youngs_modulus = 1e4;
    jelly.model = MaterialModel::neo_hookean;
    ObjectDescription& ball = scene.objects.emplace_back();
    ball.name = "ball";
    ball.material = "jelly";
    ball.shape = SphereShape{.radius = 0.3, .frequency = 6};
    ball.spin = {0, 0, 1440};
    const auto model = std::make_shared<const Model>(build_model(scene));
    cpu::SystemSolver<float> solver = make_system_solver<float>(model);
    const double before = sum_bodies(*model, solver.nodes()).kinetic;
    for (int frame = 0; frame < 600; ++frame) solver.advance({kFrame});
    const BodySums after = sum_bodies(*model, solver.nodes());
    EXPECT_GT(after.kinetic + after.elastic, 0.6 * before);
    EXPECT_LT(after.kinetic + after.elastic, 1.002 * before);
}

// Solids that are no surfaces with faces, as where bodies do not meet.
TEST(SystemSolver, RestsOnSolids) {
    const std::pair<Shape, double> solids[] = {
        {BoxShape{glm::dvec3(2.0)}, -1.0}, {SphereShape{3.0}, -3.0}, {CapsuleShape{3.0, 1.0}, -3.5}};
    for (const auto& [shape, height] : solids) {  // their tops are at 0
        ColliderDescription solid;
        solid.shape = shape;
        solid.position = {0, height, 0};
        solid.friction = 0.5;
        Body block = test::make_body(test::make_block({3, 3, 3}, {0.3, 0.3, 0.3}));
        block.material.youngs_modulus = 1e6;
        for (glm::dvec3& p : block.mesh.positions) p += glm::dvec3(-0.15, 0.05, -0.15);
        const auto model = std::make_shared<const Model>(pack_bodies({block}, {solid}, {0, -9.81, 0}));
        cpu::SystemSolver<float> solver(model, {.response = CollisionResponse::restore},
                                        {.divides_steps = true});
        for (int frame = 0; frame < 180; ++frame) solver.advance({kFrame});
        for (const glm::vec4& position : solver.nodes().positions) ASSERT_GT(position.y, -0.02f) << height;
        const test::BodySums sums = sum_bodies(*model, solver.nodes());
        EXPECT_LT(sums.kinetic, 1e-4) << height;
    }
}

// On a slope that is 0.98 and 1.02 times as steep as friction holds: in gravity that is turned as the slope
// is.
TEST(SystemSolver, FrictionHoldsAndLetsSlide) {
    constexpr double kFriction = 0.5, kGravity = 9.81;
    for (const double youngs_modulus : {1e6, 1e8})
        for (const double steepness : {0.98, 1.02, 1.3}) {
            const double angle = std::atan(steepness * kFriction);
            ColliderDescription ground;
            ground.shape = PlaneCollider{{0, 1, 0}, 0.0};
            ground.friction = kFriction;
            const auto model =
                make_blocks({{.place = {0, 0.002, 0},
                              .cells = {4, 2, 3},
                              .size = {0.4, 0.1, 0.3},
                              .youngs_modulus = youngs_modulus}},
                            {kGravity * std::sin(angle), -kGravity * std::cos(angle), 0.0}, {ground});
            cpu::SystemSolver<float> solver = make_system_solver<float>(model);
            const auto speed = [&] {
                return sum_bodies(*model, solver.nodes()).momentum.x / model->objects[0].mass;
            };
            for (int frame = 0; frame < 60; ++frame) solver.advance({kFrame});
            const double at_one_second = speed();
            for (int frame = 0; frame < 60; ++frame) solver.advance({kFrame});
            const double gained = speed() - at_one_second;
            const double expected = std::max(0.0, kGravity * (std::sin(angle) - kFriction * std::cos(angle)));
            EXPECT_NEAR(gained, expected, 0.005 * expected + 1e-4) << youngs_modulus << ' ' << steepness;
        }
}

// Stiff blocks that begin near the ground, or in it, come to rest there; what lies in it is lifted, not
// thrown.
TEST(SystemSolver, StartsNearTheGroundInPeace) {
    for (const bool has_plane : {true, false})
        for (const double height : {0.0001, 0.002, -0.03}) {
            if (!has_plane && height < 0.0) continue;  // bodies that cross are refused
            ColliderDescription ground;
            if (has_plane) {
                ground.shape = PlaneCollider{{0, 1, 0}, 0.0};
            } else {
                ground.shape = Shape{BoxShape{.size = {6.0, 1.0, 2.0}}};
                ground.position = {0.0, -0.5, 0.0};
            }
            const auto model = make_blocks({{.place = {0, height, 0},
                                             .cells = {4, 1, 4},
                                             .size = {0.4, 0.1, 0.4},
                                             .youngs_modulus = 1e8}},
                                           {0, -9.81, 0}, {ground});
            cpu::SystemSolver<float> solver = make_system_solver<float>(model);
            double fastest = 0.0;
            for (int frame = 0; frame < 90; ++frame) {
                solver.advance({kFrame});
                const glm::dvec3 momentum = sum_bodies(*model, solver.nodes()).momentum;
                fastest = std::max(fastest, momentum.y / model->objects[0].mass);
            }
            EXPECT_LT(fastest, std::max(0.05, -15.0 * height)) << has_plane << ' ' << height;
            const BodySums sums = sum_bodies(*model, solver.nodes());
            EXPECT_LT(glm::length(sums.momentum), 1e-3 * model->objects[0].mass)
                << has_plane << ' ' << height;
        }
}

// What a block presses the ground with is its weight, once it rests.
TEST(SystemSolver, ReportsForces) {
    ColliderDescription ground;
    ground.shape = PlaneCollider{{0, 1, 0}, 0.0};
    const auto model = make_blocks({{.place = {0, 0.001, 0}}}, {0, -9.81, 0}, {ground});
    cpu::SystemSolver<float> solver = make_system_solver<float>(model);
    for (int frame = 0; frame < 120; ++frame) solver.advance({kFrame});
    const ContactForces forces = solver.contact_forces();
    ASSERT_EQ(forces.between.size(), 1u);
    EXPECT_TRUE(forces.between[0].is_plane);
    const double weight = 9.81 * model->objects[0].mass;
    EXPECT_NEAR(forces.between[0].normal.y, weight, 0.02 * weight);
}

}  // namespace
}  // namespace gelatin
