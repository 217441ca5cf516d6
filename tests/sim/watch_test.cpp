// A run is stopped at the step that ruins it, and not before; what is good stays.
#include "sim/watch.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "core/file.h"
#include "cpu/explicit/explicit_solver.h"
#include "gelatin/error.h"
#include "gelatin/simulator.h"
#include "gpu/explicit/explicit_solver.h"
#include "model/assembly/build_model.h"
#include "model/explicit/stability.h"
#include "sim/checkpoint.h"
#include "sim/simulator_internals.h"
#include "support/simulator_fixture.h"
#include "support/test_models.h"

namespace gelatin {
namespace {

using ::testing::HasSubstr;

using WatchTest = test::SimulatorFixture;

// In free fall.
Scene two_balls() {
    Scene scene = test::falling_balls();
    scene.simulation.frame_rate = 100.0;
    scene.materials[0].damping = Material().damping;
    for (ObjectDescription& ball : scene.objects) ball.position.y = 5.0;
    scene.colliders.clear();
    return scene;
}

// Steps of twice the largest stable one make every solver explode, and at the same step.
TEST_F(WatchTest, NamesTheFirstStepOfAnExplosionAsTheOracleDoes) {
    const auto model = std::make_shared<const Model>(test::make_lively_model());
    const auto kind = SolverKind::semi_implicit_euler;
    const double step = 2.0 * largest_stable_step(kind, *model);
    cpu::ExplicitSolver<double> oracle(model, kind, ForceMethod::fused);
    cpu::ExplicitSolver<float> cpu(model, kind, ForceMethod::fused);
    gpu::ExplicitSolver gpu(model, kind, ForceMethod::fused);
    constexpr double kMostEnergy = 1e9;  // [J]
    for (std::uint32_t s = 1; s <= 100; ++s) {
        for (Solver* solver :
             {static_cast<Solver*>(&oracle), static_cast<Solver*>(&cpu), static_cast<Solver*>(&gpu)}) {
            solver->advance({step});
            solver->watch_nodes(s, kMostEnergy);
        }
    }
    const Alarm expected = oracle.alarm(true);
    EXPECT_GT(expected.step, 2u);
    EXPECT_LT(expected.step, 100u);
    for (const Alarm& alarm : {cpu.alarm(true), gpu.alarm(true)}) {
        EXPECT_EQ(alarm.step, expected.step);
        EXPECT_EQ(alarm.node, expected.node);
        EXPECT_EQ(alarm.count, expected.count);
    }
}

// A node that is not a number ruins its neighbours in the first step.
TEST_F(WatchTest, StopsAtTheFirstStepOnEitherBackend) {
    const TemporaryFolder folder;
    const std::filesystem::path file = folder.path() / "bad.ckpt";
    for (const Backend backend : {Backend::cpu, Backend::gl}) {
        Scene scene = two_balls();
        scene.objects.erase(scene.objects.begin());
        Simulator simulator(scene, on(backend));
        simulator.advance_frame();
        const Model& model = model_of(simulator);
        simulator.save_checkpoint(file);
        Checkpoint checkpoint = read_checkpoint(file, model);
        checkpoint.state.velocities[30].y = std::numeric_limits<float>::quiet_NaN();
        write_checkpoint(file, model, checkpoint);

        cpu::ExplicitSolver<double> oracle(std::make_shared<const Model>(model),
                                           SolverKind::semi_implicit_euler, ForceMethod::fused);
        oracle.write_state(checkpoint.state);
        oracle.advance({simulator.step_size()});
        oracle.watch_nodes(1, 1e30);

        simulator.load_checkpoint(file);
        try {
            // A device may be some frames behind, and reports it when it gets there.
            for (int f = 0; f < 1000; ++f) simulator.advance_frame();
            ADD_FAILURE() << "went on";
        } catch (const Diverged& error) {
            EXPECT_EQ(error.where().step, static_cast<std::uint64_t>(simulator.substeps()) + 1);
            EXPECT_EQ(error.where().frame, 2);
            EXPECT_NEAR(error.where().time, 0.01 + simulator.step_size(), 1e-9);
            EXPECT_EQ(error.where().object, "ball 1");
            EXPECT_EQ(error.where().node, oracle.alarm(true).node);
            EXPECT_THAT(error.what(), HasSubstr("not finite"));
            EXPECT_THAT(error.what(), HasSubstr("likely cause: "));
        }
        const std::string before = read_file(file);
        EXPECT_THROW(simulator.save_checkpoint(file), Diverged);
        EXPECT_EQ(read_file(file), before) << "a state of no use took a checkpoint's place";
        EXPECT_THROW(simulator.check(), Diverged);
    }
}

// All nodes put on a line: springs that now all pull along it are too stiff for steps that suit the shape at
// rest.
State crushed(const Model& model) {
    State state{model.positions, model.velocities, {}};
    for (std::size_t n = 0; n < state.positions.size(); ++n) {
        glm::vec4& p = state.positions[n];
        p = glm::vec4(p.x + 0.6f * p.y + 0.36f * p.z, 0.0f, 0.0f, p.w);
        state.velocities[n].x = n % 2 == 0 ? 0.1f : -0.1f;
    }
    return state;
}

// The explosion begins out of sight. The step that is named is the oracle's, and what was saved before it is
// sound.
TEST_F(WatchTest, FindsAnExplosionAtTheOraclesStepAndKeepsTheLastGoodCheckpoint) {
    const TemporaryFolder folder;
    const std::filesystem::path file = folder.path() / "last.ckpt";
    for (const Backend backend : {Backend::cpu, Backend::gl}) {
        Scene scene = two_balls();
        scene.simulation.gravity = glm::dvec3(0.0);
        scene.objects.resize(1);
        scene.objects[0].shape = BoxShape{{2.0, 0.1, 0.1}, {20, 1, 1}};
        scene.simulation.substeps = 1;  // as long as is allowed
        scene.simulation.frame_rate =
            1.0 / (0.99 * largest_stable_step(scene.simulation.solver, build_model(scene)));
        Simulator simulator(scene, on(backend));
        const auto model = std::make_shared<const Model>(model_of(simulator));
        const State start = crushed(*model);
        write_checkpoint(file, *model, {0, 0.0, start});

        Watch watch(scene, model, simulator.substeps());
        watch.begin(start, {});
        cpu::ExplicitSolver<double> oracle(model, scene.simulation.solver, ForceMethod::fused);
        oracle.write_state(start);
        std::uint32_t step = 0;
        while (oracle.alarm(true).count == 0 && step < 10'000) {
            oracle.advance({simulator.step_size()});
            ++step;
            oracle.watch_nodes(step, watch.most_energy(step * simulator.step_size()));
        }
        ASSERT_GT(step, 5u);
        ASSERT_LT(step, 10'000u);

        simulator.load_checkpoint(file);
        int saved = 0;
        try {
            for (;; saved = simulator.frame()) {
                simulator.advance_frame();
                simulator.save_checkpoint(file);
            }
        } catch (const Diverged& error) {
            EXPECT_EQ(error.where().step, step);
            EXPECT_EQ(error.where().node, oracle.alarm(true).node);
            EXPECT_EQ(error.where().frame, saved + 1);
            EXPECT_THAT(error.what(), HasSubstr("moved at up to "));
            EXPECT_THAT(error.what(),
                        HasSubstr("but not for bodies that are strongly compressed or stretched"));
        }
        EXPECT_GT(saved, 0);
        Simulator again(scene, on(backend));
        again.load_checkpoint(file);
        EXPECT_EQ(again.frame(), saved);
        EXPECT_NO_THROW(again.check());
        again.begin_statistics();
        EXPECT_NO_THROW(again.take_statistics());
    }
}

TEST_F(WatchTest, GoesOnOnceAGoodCheckpointIsLoaded) {
    const TemporaryFolder folder;
    for (const Backend backend : {Backend::cpu, Backend::gl}) {
        Simulator simulator(two_balls(), on(backend));
        const std::filesystem::path good = folder.path() / "good", bad = folder.path() / "bad";
        simulator.save_checkpoint(good);
        Checkpoint checkpoint = read_checkpoint(good, model_of(simulator));
        checkpoint.state.positions[3].x = std::numeric_limits<float>::infinity();
        write_checkpoint(bad, model_of(simulator), checkpoint);
        simulator.load_checkpoint(bad);
        EXPECT_THROW(
            {
                simulator.step();
                simulator.check();
            },
            Diverged);
        simulator.load_checkpoint(good);
        for (int f = 0; f < 3; ++f) simulator.advance_frame();
        EXPECT_NO_THROW(simulator.check());
        EXPECT_EQ(simulator.frame(), 3);
    }
}

// Five minutes of free fall, after a shot at 500 m/s.
TEST_F(WatchTest, LetsFastBodiesFall) {
    Scene scene = two_balls();
    scene.simulation.frame_rate = 1.0;
    scene.materials[0].youngs_modulus = 100.0;
    scene.objects.resize(1);
    for (const double speed : {0.0, 500.0}) {
        scene.objects[0].velocity = {speed, 0.0, 0.0};
        Simulator simulator(scene, on(Backend::cpu));
        for (int f = 1; f <= 300; ++f) {
            simulator.advance_frame();
            simulator.begin_statistics();
            EXPECT_NO_THROW(simulator.take_statistics());
        }
    }
}

TEST_F(WatchTest, DoesNotExplainEnergyFromNothing) {
    const Scene scene = two_balls();
    Simulator simulator(scene, on(Backend::cpu));
    Watch watch(scene, std::make_shared<const Model>(model_of(simulator)), simulator.substeps());
    std::vector<ObjectMeasure> objects(2);
    watch.check(objects, {1, 0.01, 10});
    objects[1].kinetic_energy = 1e9;
    try {
        watch.check(objects, {2, 0.02, 20});
        ADD_FAILURE() << "was explained";
    } catch (const Diverged& error) {
        EXPECT_EQ(error.where().object, "ball 1");
        EXPECT_EQ(error.where().frame, 2);
    }
    objects[1].potential_energy = -2e9;
    EXPECT_NO_THROW(watch.check(objects, {2, 0.02, 20})) << "gravity gave it";
    objects[0].elastic_energy = std::numeric_limits<double>::quiet_NaN();
    EXPECT_THROW(watch.check(objects, {3, 0.03, 30}), Diverged);
}

// While a handle moves or lets go any energy is explained, and what it was is the start of what follows.
TEST_F(WatchTest, HandlesExplainEnergyWhileTheyMove) {
    Scene scene = two_balls();
    HandleDescription handle;
    handle.region = HalfSpaceRegion{{1.0, 0.0, 0.0}, 10.0};
    handle.keyframes = {{1.0}, {2.0, {1.0, 0.0, 0.0}}};
    handle.release = 3.0;
    scene.objects[0].handles = {handle};
    const Simulator simulator(scene, on(Backend::cpu));
    Watch watch(scene, std::make_shared<const Model>(model_of(simulator)), simulator.substeps());
    std::vector<ObjectMeasure> objects(2);
    const auto check_at = [&](double time, double energy) {
        objects[0].kinetic_energy = energy;
        watch.check(objects, {static_cast<int>(100.0 * time), time, 0});
    };
    check_at(0.5, 0.0);
    EXPECT_THROW(check_at(0.9, 1e9), Diverged) << "not yet";
    EXPECT_GT(watch.most_energy(1.5), 1e30);
    check_at(1.0, 0.0);
    EXPECT_NO_THROW(check_at(1.5, 1e9));
    EXPECT_NO_THROW(check_at(2.0, 1e8));
    EXPECT_LT(watch.most_energy(2.1), 1e10);
    EXPECT_NO_THROW(check_at(2.5, 1e9)) << "within ten times what was there";
    EXPECT_THROW(check_at(2.7, 1e11), Diverged) << "it rests";
    EXPECT_NO_THROW(check_at(3.01, 1e11)) << "it lets go";
    EXPECT_THROW(check_at(3.5, 1e13), Diverged) << "gone";
    objects[1].elastic_energy = std::numeric_limits<double>::quiet_NaN();
    EXPECT_THROW(check_at(1.5, 0.0), Diverged);
}

TEST_F(WatchTest, AHandExplainsEnergyWhileItHolds) {
    const Scene scene = two_balls();
    const Simulator simulator(scene, on(Backend::cpu));
    Watch watch(scene, std::make_shared<const Model>(model_of(simulator)), simulator.substeps());
    std::vector<ObjectMeasure> objects(2);
    const auto check_at = [&](double time, double energy) {
        objects[0].kinetic_energy = energy;
        watch.check(objects, {static_cast<int>(100.0 * time), time, 0});
    };
    EXPECT_THROW(check_at(0.1, 1e9), Diverged) << "nobody holds it";
    watch.note_hand(0.2);
    EXPECT_GT(watch.most_energy(0.2), 1e30);
    EXPECT_NO_THROW(check_at(0.2, 1e9));
    watch.note_hand(0.3);
    EXPECT_NO_THROW(check_at(0.25, 1e11)) << "of before it let go";
    EXPECT_NO_THROW(check_at(0.35, 1e13)) << "of the time since the last account it held for a part";
    EXPECT_LT(watch.most_energy(0.4), 1e15);
    EXPECT_THROW(check_at(0.4, 1e15), Diverged);
    watch.begin({model_of(simulator).positions, model_of(simulator).velocities, {}}, {});
    EXPECT_THROW(check_at(0.1, 1e9), Diverged) << "back at the start it holds nothing";
}

TEST_F(WatchTest, LoadsExplainWhatTheyCanGive) {
    Scene scene = two_balls();
    scene.simulation.gravity = glm::dvec3(0.0);
    scene.objects[0].loads = {{HalfSpaceRegion{{1.0, 0.0, 0.0}, 10.0}, ForceLoad{{0.0, 1e6, 0.0}}}};
    const Simulator simulator(scene, on(Backend::cpu));
    Watch watch(scene, std::make_shared<const Model>(model_of(simulator)), simulator.substeps());
    const double mass = model_of(simulator).objects[0].mass;
    std::vector<ObjectMeasure> objects(2);
    for (const double time : {1.0, 10.0}) {
        objects[0].kinetic_energy = 0.5 * std::pow(1e6 * time, 2) / mass;
        EXPECT_NO_THROW(watch.check(objects, {1, time, 1}));
    }
    objects[0].kinetic_energy *= 30.0;
    EXPECT_THROW(watch.check(objects, {11, 10.1, 11}), Diverged);
}

}  // namespace
}  // namespace gelatin
