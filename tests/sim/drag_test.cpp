// What pins and handles hold follows a user who drags it, in all solvers and on both backends.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include "core/file.h"
#include "gelatin/error.h"
#include "gelatin/simulator.h"
#include "model/model.h"
#include "sim/simulator_internals.h"
#include "support/simulator_fixture.h"
#include "support/solver_kinds.h"

namespace gelatin {
namespace {

// A bar along x from the origin, pinned at its left, and at its right a handle that lifts it by 10 cm.
Scene held_bar(SolverKind solver = SolverKind::implicit, bool has_handle = false) {
    Scene scene;
    scene.simulation.solver = solver;
    scene.simulation.frame_rate = 100.0;
    scene.simulation.gravity = glm::dvec3(0.0);
    scene.materials.push_back({});
    scene.materials[0].name = "jelly";
    scene.materials[0].youngs_modulus = 2e5;
    scene.materials[0].damping = 0.05;
    ObjectDescription bar;
    bar.name = "bar";
    bar.shape = BoxShape{{0.6, 0.2, 0.2}, {6, 2, 2}};
    bar.material = "jelly";
    bar.position = {0.3, 0.0, 0.0};
    bar.pins = {HalfSpaceRegion{{1.0, 0.0, 0.0}, 0.01}};
    HandleDescription handle;
    handle.region = HalfSpaceRegion{{-1.0, 0.0, 0.0}, -0.59};
    handle.keyframes = {{0.0}, {0.2, {0.0, 0.1, 0.0}}};
    if (has_handle) bar.handles = {handle};
    scene.objects.push_back(bar);
    return scene;
}

const Drag kDrag{{0.1, 0.25, -0.1}, glm::angleAxis(0.6, glm::normalize(glm::dvec3(1.0, 2.0, -1.0)))};

glm::dvec3 node(const HostFrame& frame, std::uint32_t n) {
    return {frame.positions[3 * n], frame.positions[3 * n + 1], frame.positions[3 * n + 2]};
}

void advance(Simulator& simulator, int frames) {
    for (int f = 0; f < frames; ++f) simulator.advance_frame();
}

using DragTest = test::SimulatorFixture;

// Where a rigid motion takes a point at rest.
glm::dvec3 dragged(const HeldNodes& nodes, const Drag& drag, const glm::dvec3& point) {
    const glm::dvec3 pivot = nodes.pivot - nodes.drag.move;  // of a pin
    return pivot + drag.move + drag.turn * (point - pivot);
}

// Once a body that is held at one end has come to rest, it has moved as its pin has: a rigid motion.
TEST_F(DragTest, ABodyFollowsItsPin) {
    for (const SolverKind solver : test::kSolvers) {
        for (const Backend backend : {Backend::cpu, Backend::gl}) {
            if (backend == Backend::gl && solver != SolverKind::implicit) continue;
            Simulator simulator(held_bar(solver), on(backend));
            ASSERT_EQ(simulator.held_nodes().size(), 1u);
            const HeldNodes before = simulator.held_nodes()[0];
            EXPECT_TRUE(before.is_pin);
            EXPECT_LT(glm::length(before.center), 1e-6);
            simulator.drag(0, kDrag);
            EXPECT_EQ(simulator.held_nodes()[0].target, kDrag);
            advance(simulator, 200);
            const HeldNodes after = simulator.held_nodes()[0];
            EXPECT_EQ(after.drag, kDrag) << "it has arrived";
            EXPECT_LT(glm::distance(after.center, dragged(before, kDrag, before.center)), 1e-6);
            const HostFrame frame = simulator.read_frame();
            const Model& model = model_of(simulator);
            for (std::uint32_t n = 0; n < model.node_count(); ++n) {
                const glm::dvec3 expected = dragged(before, kDrag, glm::dvec3(model.positions[n]));
                const bool is_held = model.positions[n].w == 0.0f;
                EXPECT_LT(glm::distance(node(frame, n), expected), is_held ? 1e-6 : 0.02)
                    << simulator.backend() << static_cast<int>(solver);
                if (is_held) {
                    EXPECT_EQ(frame.velocities[3 * n + 1], 0.0f) << "it rests";
                }
            }
        }
    }
}

TEST_F(DragTest, BackendsAgree) {
    for (const SolverKind solver : {SolverKind::implicit, SolverKind::semi_implicit_euler}) {
        const Scene scene = held_bar(solver, true);
        Simulator gl(scene, on(Backend::gl)), cpu(scene, on(Backend::cpu));
        for (Simulator* simulator : {&gl, &cpu}) {
            advance(*simulator, 3);
            simulator->drag(0, kDrag);
            simulator->drag(1, {{-0.1, 0.0, 0.0}});
            advance(*simulator, 12);
        }
        const HostFrame a = gl.read_frame(), b = cpu.read_frame();
        double worst = 0.0;
        for (std::uint32_t n = 0; n < model_of(gl).node_count(); ++n)
            worst = std::max(worst, glm::distance(node(a, n), node(b, n)));
        EXPECT_LT(worst, 1e-4);
    }
}

// Keyframes go on; the drag is on top of them, at any time.
TEST_F(DragTest, AHandleIsDraggedAwayFromItsKeyframes) {
    for (const Backend backend : {Backend::cpu, Backend::gl}) {
        Simulator simulator(held_bar(SolverKind::implicit, true), on(backend));
        EXPECT_FALSE(simulator.held_nodes()[0].is_pin);
        EXPECT_TRUE(simulator.held_nodes()[1].is_pin);
        const Drag aside{{0.0, 0.0, 0.2}, kDrag.turn};
        simulator.drag(0, aside);
        for (int f = 1; f <= 60; ++f) {
            simulator.advance_frame();
            const HeldNodes held = simulator.held_nodes()[0];
            const double lift = 0.1 * std::min(1.0, simulator.time() / 0.2);
            const glm::dvec3 expected = glm::dvec3(0.6, lift, 0.0) + held.drag.move;
            EXPECT_LT(glm::distance(held.center, expected), 1e-6);
        }
        EXPECT_EQ(simulator.held_nodes()[0].drag, aside);
        const HostFrame frame = simulator.read_frame();
        const Model& model = model_of(simulator);
        for (const HandleNode& nodes : model.handle_nodes) {
            if (nodes.handle != 0) continue;
            const glm::dvec3 expected = glm::dvec3(0.6, 0.1, 0.2) + kDrag.turn * glm::dvec3(nodes.arm);
            EXPECT_LT(glm::distance(node(frame, nodes.node), expected), 1e-5);
        }
    }
}

// However far it is dragged at once, no spring is ever twice as long or as short as it was.
TEST_F(DragTest, DoesNotTearTheBody) {
    for (const SolverKind solver : {SolverKind::implicit, SolverKind::semi_implicit_euler}) {
        Simulator simulator(held_bar(solver), on(Backend::cpu));
        simulator.drag(0, {{30.0, -20.0, 10.0}, kDrag.turn});
        double longest = 0.0;
        for (int f = 0; f < 100; ++f) {
            simulator.advance_frame();
            const HostFrame frame = simulator.read_frame();
            for (const Spring& spring : model_of(simulator).springs) {
                const double length = glm::distance(node(frame, spring.i), node(frame, spring.j));
                longest = std::max(longest, length / static_cast<double>(spring.rest_length));
            }
            simulator.begin_statistics();
            EXPECT_NO_THROW(simulator.take_statistics());
        }
        EXPECT_LT(longest, 2.0);
        EXPECT_GT(longest, 1.1) << "it is dragged as fast as it can follow";
        EXPECT_GT(glm::length(simulator.held_nodes()[0].center), 1.0);
    }
}

TEST_F(DragTest, WhatNobodyDragsCostsNothing) {
    for (const Backend backend : {Backend::cpu, Backend::gl}) {
        SimulatorOptions options = on(backend);
        options.time_stages = true;
        Simulator simulator(held_bar(), options);
        const auto is_run = [&] {
            simulator.read_frame();
            const auto times = simulator.take_stage_times();
            return std::any_of(times.begin(), times.end(),
                               [](const auto& stage) { return stage.first == "apply_kinematics"; });
        };
        advance(simulator, 3);
        EXPECT_FALSE(is_run());
        simulator.drag(0, kDrag);
        advance(simulator, 3);
        EXPECT_TRUE(is_run());
    }
}

TEST_F(DragTest, ResetPutsItBack) {
    for (const Backend backend : {Backend::cpu, Backend::gl}) {
        Simulator simulator(held_bar(SolverKind::implicit, true), on(backend));
        const HostFrame start = simulator.read_frame();
        const auto run = [&] {
            simulator.drag(1, kDrag);
            advance(simulator, 7);
            return simulator.read_frame();
        };
        const HostFrame first = run();
        simulator.reset();
        EXPECT_EQ(simulator.read_frame().positions, start.positions);
        EXPECT_EQ(simulator.held_nodes()[1].drag, Drag());
        EXPECT_EQ(simulator.held_nodes()[1].target, Drag());
        EXPECT_EQ(run().positions, first.positions);
    }
}

// A run that goes on half way through a drag has the numbers of one in one go.
TEST_F(DragTest, CheckpointsKnowOfIt) {
    const TemporaryFolder folder;
    const std::filesystem::path file = folder.path() / "dragged.ckpt";
    for (const Backend backend : {Backend::cpu, Backend::gl}) {
        Simulator whole(held_bar(SolverKind::implicit, true), on(backend));
        whole.drag(0, {{0.1, 0.0, 0.0}});
        whole.drag(1, kDrag);
        advance(whole, 5);
        whole.save_checkpoint(file);
        Simulator again(held_bar(SolverKind::implicit, true), on(backend));
        again.load_checkpoint(file);
        EXPECT_EQ(again.held_nodes()[1].drag, whole.held_nodes()[1].drag);
        EXPECT_NE(again.held_nodes()[1].drag, kDrag);
        EXPECT_EQ(again.held_nodes()[1].target, kDrag);
        advance(whole, 8);
        advance(again, 8);
        EXPECT_EQ(again.read_frame().positions, whole.read_frame().positions);
        EXPECT_EQ(again.read_frame().velocities, whole.read_frame().velocities);
    }
    Simulator other(held_bar(), on(Backend::cpu));
    EXPECT_THROW(other.load_checkpoint(file), InvalidInput) << "it has no handle";
}

// Before an edited scene takes over, the drag is under way; after, it goes on from where it was.
TEST_F(DragTest, GoesOnInAnEditedScene) {
    for (const Backend backend : {Backend::cpu, Backend::gl}) {
        Scene scene = held_bar(SolverKind::implicit, true);
        Simulator before(scene, on(backend));
        before.drag(0, {{0.0, 0.0, 0.1}});
        before.drag(1, kDrag);
        advance(before, 5);
        scene.materials[0].youngs_modulus *= 2.0;
        scene.objects.insert(scene.objects.begin(), scene.objects[0]);
        scene.objects[0].name = "another";
        scene.objects[0].position.z = 2.0;
        Simulator after(scene, on(backend));
        after.go_on_from(before);
        EXPECT_EQ(after.held_nodes()[0].drag, Drag()) << "of the new body";
        EXPECT_EQ(after.held_nodes()[2].target, before.held_nodes()[0].target);
        EXPECT_EQ(after.held_nodes()[3].drag, before.held_nodes()[1].drag);
        EXPECT_EQ(after.held_nodes()[3].target, kDrag);
        EXPECT_LT(glm::distance(after.held_nodes()[3].center, before.held_nodes()[1].center), 1e-9);
        advance(after, 100);
        EXPECT_EQ(after.held_nodes()[3].drag, kDrag);
    }
}

// Nodes that a new pin holds stay where they are: as near as they can as a rigid group.
TEST_F(DragTest, APinThatIsAddedHoldsItsNodesWhereTheyAre) {
    for (const Backend backend : {Backend::cpu, Backend::gl}) {
        Scene scene = held_bar();
        Simulator before(scene, on(backend));
        before.drag(0, kDrag);
        advance(before, 10);
        HandleDescription pin;
        pin.region = HalfSpaceRegion{{-1.0, 0.0, 0.0}, -0.49};
        scene.objects[0].handles = {pin};
        Simulator after(scene, on(backend));
        after.go_on_from(before);
        const HostFrame there = before.read_frame();
        advance(after, 20);
        const HostFrame here = after.read_frame();
        glm::dvec3 mean(0.0);
        double farthest = 0.0, moved = 0.0;
        std::size_t count = 0;
        for (const HandleNode& held : model_of(after).handle_nodes) {
            const glm::dvec3 displacement = node(here, held.node) - node(there, held.node);
            if (held.handle != 0) {
                moved = std::max(moved, glm::length(displacement));
                continue;
            }
            mean += displacement;
            ++count;
            farthest = std::max(farthest, glm::length(displacement));
        }
        ASSERT_GT(count, 8u);
        EXPECT_LT(glm::length(mean) / static_cast<double>(count), 1e-6);
        EXPECT_LT(farthest, 0.02) << "by how much they were out of shape";
        EXPECT_GT(moved, 0.05) << "the other end is dragged on";

        // Without any the body keeps the momentum that it has.
        scene.objects[0].handles.clear();
        scene.objects[0].pins.clear();
        Simulator loose(scene, on(backend));
        loose.go_on_from(after);
        EXPECT_TRUE(loose.held_nodes().empty());
        advance(loose, 20);
        EXPECT_GT(glm::distance(node(loose.read_frame(), model_of(after).handle_nodes[0].node),
                                node(here, model_of(after).handle_nodes[0].node)),
                  1e-3);
    }
}

}  // namespace
}  // namespace gelatin
