#include "gelatin/simulator.h"

#include <gtest/gtest.h>

#include "core/file.h"
#include "gelatin/error.h"
#include "model/model.h"
#include "sim/simulator_internals.h"
#include "support/simulator_fixture.h"
#include "support/source_path.h"

namespace gelatin {
namespace {

using test::driven_balls, test::falling_balls, test::largest_difference;

using SimulatorTest = test::SimulatorFixture;

TEST_F(SimulatorTest, FramesTimesAndCountsAddUp) {
    Simulator simulator(falling_balls(), on(Backend::cpu));
    EXPECT_EQ(simulator.frame(), 0);
    for (int f = 0; f < 5; ++f) simulator.advance_frame();
    EXPECT_EQ(simulator.frame(), 5);
    EXPECT_NEAR(simulator.time(), 0.01, 1e-12);
    EXPECT_NEAR(simulator.step_size() * simulator.substeps(), 0.002, 1e-12);
    const Counts counts = simulator.counts();
    EXPECT_EQ(counts.objects, 2u);
    EXPECT_GE(counts.faces, 2u * 320u);
    EXPECT_EQ(counts.nodes, model_of(simulator).positions.size());
}

// Both backends in float from the same bits: they differ by rounding, 1e-7 of coordinates of a metre a step,
// that adds up at most linearly as long as nothing amplifies it. A wrong kernel is off by millimetres.
TEST_F(SimulatorTest, BackendsAgreeOnFreeFallAfter100Steps) {
    const Scene scene = load_scene(test::source_path("scenes/free_fall.toml"));
    Simulator gl(scene, on(Backend::gl)), cpu(scene, on(Backend::cpu));
    EXPECT_EQ(gl.backend(), "gl");
    EXPECT_EQ(cpu.backend(), "cpu");
    for (int s = 0; s < 100; ++s) {
        gl.step();
        cpu.step();
    }
    ASSERT_EQ(gl.read_frame().positions.size(), cpu.read_frame().positions.size());
    EXPECT_LT(largest_difference(gl.read_frame(), cpu.read_frame()), 100 * 1e-6)
        << "half a unit in the last place a step, of coordinates up to 26 m";
}

// The same through an impact on the floor.
TEST_F(SimulatorTest, BackendsAgreeThroughAnImpact) {
    Simulator gl(falling_balls(), on(Backend::gl)), cpu(falling_balls(), on(Backend::cpu));
    std::size_t contacts = 0;
    for (int f = 0; f < 120; ++f) {
        gl.advance_frame();
        cpu.advance_frame();
        cpu.begin_statistics();
        contacts += cpu.take_statistics().contacts;
    }
    EXPECT_GT(contacts, 100u);
    EXPECT_LT(largest_difference(gl.read_frame(), cpu.read_frame()), 1e-4);
}

TEST_F(SimulatorTest, StatisticsHaveToBeBegun) {
    Simulator cpu(falling_balls(), on(Backend::cpu));
    EXPECT_THROW(cpu.take_statistics(), InvalidInput);
}

TEST_F(SimulatorTest, DepthNeedsGl) {
    Scene scene = falling_balls();
    scene.file = "balls.toml";
    scene.collision.broad_phase = BroadPhase::depth;
    EXPECT_TRUE(Simulator(scene, on(Backend::automatic)).uses_gl());
    try {
        Simulator(scene, on(Backend::cpu));
        ADD_FAILURE() << "not refused";
    } catch (const InvalidInput& error) {
        EXPECT_STREQ(error.what(),
                     "balls.toml: collision.broad_phase = \"depth\": needs OpenGL; with --backend cpu it "
                     "must be none, "
                     "boxes or hierarchy");
    }
}

TEST_F(SimulatorTest, ChecksScenesMadeInCode) {
    Scene scene = falling_balls();
    scene.simulation.substeps = 0;
    try {
        Simulator(scene, on(Backend::cpu));
        FAIL() << "accepted";
    } catch (const InvalidInput& error) {
        EXPECT_STREQ(error.what(), "simulation.substeps = 0: must be \"auto\" or from 1 to 1000000");
    }
}

TEST_F(SimulatorTest, RefusesARadiusByDepth) {
    Scene scene = falling_balls();
    scene.collision.proximity_radius = 0.1;
    scene.collision.broad_phase = BroadPhase::depth;
    EXPECT_THROW(Simulator(scene, on(Backend::gl)), InvalidInput);
}

TEST_F(SimulatorTest, BackendsAgreeOnHandlesAndLoads) {
    for (const SolverKind solver : {SolverKind::semi_implicit_euler, SolverKind::implicit}) {
        const Scene scene = driven_balls(solver);
        SimulatorOptions options = on(Backend::gl);
        options.time_stages = true;
        Simulator gl(scene, options), cpu(scene, on(Backend::cpu));
        for (int f = 0; f < 30; ++f) {
            gl.advance_frame();
            cpu.advance_frame();
        }
        EXPECT_LT(largest_difference(gl.read_frame(), cpu.read_frame()), 1e-4);
        bool is_timed = false;
        for (const auto& [stage, times] : gl.take_stage_times()) is_timed |= stage == "apply_kinematics";
        EXPECT_TRUE(is_timed);
        const Simulator fresh(scene, on(Backend::cpu));
        EXPECT_GT(largest_difference(gl.read_frame(), fresh.read_frame()), 1e-2) << "something happens";
    }
}

TEST_F(SimulatorTest, DrawsFromEitherBackend) {
    for (const Backend backend : {Backend::cpu, Backend::gl}) {
        Simulator simulator(falling_balls(), on(backend));
        simulator.advance_frame();
        const RenderView view = simulator.render_view();
        EXPECT_NE(view.node_positions, 0u);
        EXPECT_EQ(view.node_count, simulator.counts().nodes);
        EXPECT_EQ(view.face_count, simulator.counts().faces);
        EXPECT_EQ(view.object_count, 2u);
        EXPECT_NEAR(view.box_min[1], 0.1f, 1e-3f);
        EXPECT_NEAR(view.box_max[0], 1.3f, 1e-3f);
    }
}

TEST(Simulator, WithoutAContextItCannotDraw) {
    SimulatorOptions options;
    options.backend = Backend::cpu;
    Simulator simulator(falling_balls(), options);
    EXPECT_THROW(simulator.render_view(), NoOpenGl);
}

}  // namespace
}  // namespace gelatin
