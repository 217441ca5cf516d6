#include "gelatin/simulator.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>

#include "core/file.h"
#include "gelatin/error.h"
#include "model/model.h"
#include "sim/simulator_internals.h"
#include "support/gl_fixture.h"
#include "support/source_path.h"

namespace gelatin {
namespace {

Scene falling_balls() {
    Scene scene;
    scene.simulation.solver = SolverKind::semi_implicit_euler;
    scene.simulation.frame_rate = 500.0;
    scene.materials.push_back({});
    scene.materials[0].name = "jelly";
    scene.materials[0].damping = 5e-4;
    for (int i = 0; i < 2; ++i) {
        ObjectDescription ball;
        ball.name = "ball " + std::to_string(i);
        ball.shape = SphereShape{0.3, 4};
        ball.material = "jelly";
        ball.position = {i, 0.4, 0.0};
        scene.objects.push_back(ball);
    }
    scene.colliders.push_back({});
    return scene;
}

// A ball held at its left, turned and let go, and another one that is pushed and pressed for a while.
Scene driven_balls(SolverKind solver) {
    Scene scene = falling_balls();
    scene.simulation.solver = solver;
    HandleDescription handle;
    handle.region = HalfSpaceRegion{{1.0, 0.0, 0.0}, -0.1};
    handle.interpolation = Interpolation::smooth;
    handle.keyframes = {{0.003}, {0.05, {-0.02, 0.03, 0.0}, {30.0, 10.0, 0.0}, 1.1}};
    handle.release = 0.03;
    scene.objects[0].handles = {handle};
    LoadDescription push{HalfSpaceRegion{{0.0, 1.0, 0.0}, 0.3}, ForceLoad{{0.0, 400.0, 100.0}}};
    push.from = 0.0101;
    push.until = 0.0507;
    scene.objects[1].loads = {push, {HalfSpaceRegion{{1.0, 0.0, 0.0}, 9.0}, PressureLoad{2e3}}};
    scene.objects[1].spin = {0.0, 200.0, 0.0};
    return scene;
}

class SimulatorTest : public test::GlTest {
protected:
    // The simulator shares the fixture's context, as a host application's would.
    static SimulatorOptions on(Backend backend) {
        SimulatorOptions options;
        options.backend = backend;
        options.use_current_context = true;
        return options;
    }
};

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

double largest_difference(const HostFrame& a, const HostFrame& b) {
    double largest = 0.0;
    for (std::size_t k = 0; k < a.positions.size(); ++k) {
        largest = std::max(
            largest, std::abs(static_cast<double>(a.positions[k]) - static_cast<double>(b.positions[k])));
    }
    return largest;
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

TEST_F(SimulatorTest, StatisticsComeInOrderAndConserveEnergyInFlight) {
    for (const Backend backend : {Backend::cpu, Backend::gl}) {
        Simulator simulator(falling_balls(), on(backend));
        simulator.begin_statistics();
        const double start = simulator.take_statistics().potential_energy;
        for (int f = 1; f <= 3; ++f) {
            simulator.advance_frame();
            simulator.begin_statistics();
            if (simulator.pending_statistics() < 2) continue;
            const FrameStatistics s = simulator.take_statistics();
            EXPECT_EQ(s.frame, f - 1);
            EXPECT_NEAR(s.time, (f - 1) * 0.002, 1e-12);
            EXPECT_NEAR((s.potential_energy + s.kinetic_energy) / start, 1.0, 1e-4);
            ASSERT_EQ(s.volume_ratio.size(), 2u);
            EXPECT_NEAR(s.volume_ratio[1], 1.0, 1e-4);
        }
        EXPECT_EQ(simulator.pending_statistics(), 1u);
    }
}

// Two balls of radius 0.3 m at rest, 1 m apart.
TEST_F(SimulatorTest, MeasuresWhatIsNear) {
    for (const Backend backend : {Backend::cpu, Backend::gl}) {
        Scene scene = falling_balls();
        scene.collision.proximity_radius = 0.41;
        SimulatorOptions options = on(backend);
        options.time_stages = true;
        Simulator simulator(scene, options);
        simulator.begin_statistics();
        EXPECT_EQ(simulator.take_statistics().proximities->node_face, 0u) << "nothing was sought yet";
        simulator.step();
        simulator.begin_statistics();
        const auto near = simulator.take_statistics().proximities;
        ASSERT_TRUE(near.has_value());
        EXPECT_GT(near->node_face, 0u);
        EXPECT_GT(near->edge_edge, 0u);
        EXPECT_EQ(near->edge_edge % 2, 0u);
        EXPECT_EQ(near->lost, 0u);
        EXPECT_GE(near->nearest_gap, 0.4 - 1e-6);
        EXPECT_LT(near->nearest_gap, 0.41);
        bool is_timed = false;
        for (const auto& [stage, times] : simulator.take_stage_times())
            is_timed |= stage == "find_proximities";
        EXPECT_TRUE(is_timed);
    }
}

// Under the same names on both backends, and the step is the same with them as without.
TEST_F(SimulatorTest, TimesThePartsOfAnImplicitStep) {
    const std::vector<std::string> parts = {"advance_nodes.descend", "advance_nodes.match_shapes",
                                            "advance_nodes.move_bodies", "advance_nodes.start",
                                            "advance_nodes.update_tets"};
    for (const Backend backend : {Backend::cpu, Backend::gl}) {
        Scene scene = falling_balls();
        scene.simulation.solver = SolverKind::vbd;
        scene.simulation.substeps = 1;
        scene.simulation.iterations = 4;
        SimulatorOptions options = on(backend);
        options.time_stages = true;
        Simulator plain(scene, options);
        options.time_parts = true;
        Simulator timed(scene, options);
        for (int f = 0; f < 3; ++f) {
            plain.advance_frame();
            timed.advance_frame();
        }
        EXPECT_EQ(plain.read_frame().positions, timed.read_frame().positions);
        std::vector<std::string> found;
        for (const auto& [stage, times] : timed.take_stage_times()) {
            if (stage.find('.') != stage.npos && stage != "advance_nodes.correct") found.push_back(stage);
            if (stage == "advance_nodes.descend") {
                EXPECT_EQ(times.size(), 12u);
            }
            if (stage == "advance_nodes") {
                EXPECT_EQ(times.size(), 3u);
            }
        }
        EXPECT_EQ(found, parts);
        for (const auto& [stage, times] : plain.take_stage_times()) EXPECT_EQ(stage.find('.'), stage.npos);
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

// Of one object its own parts, where it collides with itself; else nothing is sought.
TEST_F(SimulatorTest, MeasuresWhatIsNearWithinOneObject) {
    Scene scene = falling_balls();
    scene.objects.resize(1);
    scene.collision.proximity_radius = 0.2;
    for (const bool own : {false, true}) {
        scene.collision.self_collision = own;
        std::vector<double> counts;
        for (const Backend backend : {Backend::cpu, Backend::gl}) {
            Simulator simulator(scene, on(backend));
            simulator.step();
            simulator.begin_statistics();
            const auto near = simulator.take_statistics().proximities;
            ASSERT_EQ(near.has_value(), own);
            if (own) counts.push_back(static_cast<double>(near->node_face + near->edge_edge));
        }
        if (!own) continue;
        EXPECT_GT(counts[0], 1000.0);
        EXPECT_NEAR(counts[1] / counts[0], 1.0, 0.001) << "but for rounding";
    }
}

TEST_F(SimulatorTest, RefusesARadiusByDepth) {
    Scene scene = falling_balls();
    scene.collision.proximity_radius = 0.1;
    scene.collision.broad_phase = BroadPhase::depth;
    EXPECT_THROW(Simulator(scene, on(Backend::gl)), InvalidInput);
}

TEST_F(SimulatorTest, GoesOnFromACheckpointBitForBit) {
    const TemporaryFolder folder;
    for (const Backend backend : {Backend::cpu, Backend::gl}) {
        Simulator whole(falling_balls(), on(backend)), again(falling_balls(), on(backend));
        for (int f = 0; f < 20; ++f) whole.advance_frame();
        whole.save_checkpoint(folder.path() / "a.ckpt");
        again.load_checkpoint(folder.path() / "a.ckpt");
        EXPECT_EQ(again.frame(), 20);
        for (int f = 0; f < 20; ++f) {
            whole.advance_frame();
            again.advance_frame();
        }
        EXPECT_EQ(again.frame(), 40);
        EXPECT_DOUBLE_EQ(again.time(), whole.time());
        EXPECT_EQ(again.read_frame().positions, whole.read_frame().positions);
        EXPECT_EQ(again.read_frame().velocities, whole.read_frame().velocities);
    }
}

// In the middle of a handle's motion, and of a load's time, and after the release.
TEST_F(SimulatorTest, HandlesAndLoadsGoOnFromACheckpointBitForBit) {
    const TemporaryFolder folder;
    for (const SolverKind solver : {SolverKind::semi_implicit_euler, SolverKind::vbd}) {
        for (const Backend backend : {Backend::cpu, Backend::gl}) {
            const Scene scene = driven_balls(solver);
            Simulator whole(scene, on(backend));
            std::vector<Simulator> others;
            for (int f = 0; f < 40; ++f) {
                if (f == 7 || f == 21) {
                    whole.save_checkpoint(folder.path() / "a.ckpt");
                    others.emplace_back(scene, on(backend)).load_checkpoint(folder.path() / "a.ckpt");
                }
                whole.advance_frame();
                for (Simulator& other : others) other.advance_frame();
            }
            ASSERT_EQ(others.size(), 2u);
            for (const Simulator& other : others) {
                EXPECT_EQ(other.frame(), 40);
                EXPECT_EQ(other.time(), whole.time());
                EXPECT_EQ(other.read_frame().positions, whole.read_frame().positions);
                EXPECT_EQ(other.read_frame().velocities, whole.read_frame().velocities);
            }
        }
    }
}

// A checkpoint from within a frame, which knows the frames that are done, goes on with the same times.
TEST_F(SimulatorTest, ResetGoesBackToTheVeryStart) {
    for (const Backend backend : {Backend::cpu, Backend::gl}) {
        for (const SolverKind solver : {SolverKind::semi_implicit_euler, SolverKind::vbd}) {
            Simulator simulator(driven_balls(solver), on(backend));
            const auto run = [&] {
                for (int f = 0; f < 12; ++f) simulator.advance_frame();
                return simulator.read_frame();
            };
            const HostFrame first = run();
            simulator.begin_statistics();
            simulator.reset();
            EXPECT_EQ(simulator.frame(), 0);
            EXPECT_EQ(simulator.pending_statistics(), 0u);
            const HostFrame second = run();
            EXPECT_EQ(second.positions, first.positions) << simulator.backend();
            EXPECT_EQ(second.velocities, first.velocities) << simulator.backend();
        }
    }
}

// What is edited goes on; what is new begins; masses are the edited scene's.
TEST_F(SimulatorTest, GoesOnFromAnotherSimulation) {
    for (const Backend backend : {Backend::cpu, Backend::gl}) {
        Scene scene = falling_balls();
        Simulator before(scene, on(backend));
        for (int f = 0; f < 10; ++f) before.advance_frame();
        const HostFrame there = before.read_frame();

        scene.materials[0].density *= 2.0;
        scene.simulation.solver = SolverKind::vbd;
        ObjectDescription third = scene.objects[0];
        third.name = "third";
        third.position = {0.0, 2.0, 0.0};
        scene.objects.insert(scene.objects.begin(), third);
        Simulator after(scene, on(backend));
        const HostFrame start = after.read_frame();
        after.go_on_from(before);
        EXPECT_EQ(after.time(), before.time());
        EXPECT_EQ(after.frame(), 10);
        const HostFrame here = after.read_frame();
        const std::size_t added = 3 * std::size_t{model_of(after).objects[0].nodes.count};
        EXPECT_EQ(
            std::vector(here.positions.begin() + static_cast<std::ptrdiff_t>(added), here.positions.end()),
            there.positions);
        EXPECT_EQ(
            std::vector(here.velocities.begin() + static_cast<std::ptrdiff_t>(added), here.velocities.end()),
            there.velocities);
        for (std::size_t k = 0; k < added; ++k) ASSERT_EQ(here.positions[k], start.positions[k]);

        // An impulse needs the new masses: the momentum of a fall is theirs.
        after.begin_statistics();
        before.begin_statistics();
        const double both = before.take_statistics().momentum[1];
        EXPECT_NEAR(after.take_statistics().momentum[1], 2.0 * both, 1e-3 * std::abs(both));
    }
}

TEST_F(SimulatorTest, GoesOnFromWithinAFrame) {
    const TemporaryFolder folder;
    Scene scene = driven_balls(SolverKind::vbd);
    scene.simulation.substeps = 3;
    Simulator whole(scene, on(Backend::cpu)), again(scene, on(Backend::cpu));
    for (int s = 0; s < 7; ++s) whole.step();
    whole.save_checkpoint(folder.path() / "a.ckpt");
    again.load_checkpoint(folder.path() / "a.ckpt");
    for (int s = 0; s < 11; ++s) {
        whole.step();
        again.step();
    }
    EXPECT_EQ(again.frame(), 6);
    EXPECT_EQ(again.time(), whole.time());
    EXPECT_EQ(again.read_frame().positions, whole.read_frame().positions);
}

TEST_F(SimulatorTest, BackendsAgreeOnHandlesAndLoads) {
    for (const SolverKind solver : {SolverKind::semi_implicit_euler, SolverKind::vbd}) {
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

TEST_F(SimulatorTest, StagesAreTimedWhereTheyRun) {
    for (const Backend backend : {Backend::cpu, Backend::gl}) {
        SimulatorOptions options = on(backend);
        options.time_stages = true;
        Simulator simulator(falling_balls(), options);
        for (int f = 0; f < 4; ++f) simulator.advance_frame();
        simulator.read_frame();
        const auto times = simulator.take_stage_times();
        std::vector<std::string> stages;
        for (const auto& [stage, milliseconds] : times) {
            stages.push_back(stage);
            EXPECT_GT(milliseconds.front(), 0.0);
        }
        EXPECT_EQ(stages,
                  (std::vector<std::string>{"advance_nodes", "find_face_collisions", "find_object_pairs",
                                            "respond", "update_boxes", "watch_nodes"}));
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
