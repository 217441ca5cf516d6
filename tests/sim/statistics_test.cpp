// What a simulator measures and times while it runs.
#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "sim/export_formats.h"
#include "sim/simulator_internals.h"
#include "support/simulator_fixture.h"

namespace gelatin {
namespace {

using test::falling_balls;

using StatisticsTest = test::SimulatorFixture;

TEST_F(StatisticsTest, StatisticsComeInOrderAndConserveEnergyInFlight) {
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
TEST_F(StatisticsTest, MeasuresWhatIsNear) {
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

// Of one object its own parts, where it collides with itself; else nothing is sought.
TEST_F(StatisticsTest, MeasuresWhatIsNearWithinOneObject) {
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

// A ball on the floor, one on that, and one on a box.
Scene balls_on_colliders(CollisionResponse response) {
    Scene scene = falling_balls();
    scene.simulation.solver = SolverKind::implicit;
    scene.simulation.frame_rate = 60.0;
    scene.collision.response = response;
    scene.objects.push_back(scene.objects[1]);
    scene.objects[2].name = "ball 2";
    scene.objects[0].position = {0, 0.31, 0};
    scene.objects[1].position = {0, 0.92, 0};
    scene.objects[2].position = {2, 0.51, 0};
    ColliderDescription box;
    box.shape = BoxShape{{1, 0.2, 1}};
    box.position = {2, 0.1, 0};
    scene.colliders.push_back(box);
    return scene;
}

// Not where bodies press each other.
TEST_F(StatisticsTest, CountsContactsWithColliders) {
    for (const Backend backend : {Backend::cpu, Backend::gl}) {
        for (const auto response : {CollisionResponse::contact, CollisionResponse::restore}) {
            Simulator simulator(balls_on_colliders(response), on(backend));
            simulator.begin_statistics();
            EXPECT_EQ(simulator.take_statistics().contacts, 0u) << "they fall by a centimetre first";
            for (int f = 0; f < 60; ++f) simulator.advance_frame();
            simulator.begin_statistics();
            const FrameStatistics now = simulator.take_statistics();
            EXPECT_GT(now.contacts, 0u) << simulator.backend();
            if (response != CollisionResponse::contact) continue;
            EXPECT_GE(now.contact_forces.size(), 2u);  // one may have bounced
            std::size_t points = 0;
            for (const ContactForce& force : now.contact_forces)
                if (force.collider) points += force.points;
            EXPECT_EQ(now.contacts, points);
        }
    }
}

// In the order of held_nodes(), each frame's own; by node in frames and VTU files.
TEST_F(StatisticsTest, HasForcesOfPinsAndHandles) {
    Scene scene = test::driven_balls(SolverKind::implicit);
    scene.simulation.substeps = 1;
    Simulator simulator(scene, on(Backend::cpu));
    for (int f = 0; f < 3; ++f) {
        simulator.advance_frame();
        simulator.begin_statistics();
    }
    const std::vector<HeldNodes> held = simulator.held_nodes();
    ASSERT_FALSE(held.empty());
    std::vector<double> forces;
    for (int f = 0; f < 3; ++f) {
        const FrameStatistics frame = simulator.take_statistics();
        ASSERT_EQ(frame.holding_forces.size(), held.size());
        for (std::size_t h = 0; h < held.size(); ++h) {
            EXPECT_EQ(frame.holding_forces[h].object, held[h].object);
            EXPECT_EQ(frame.holding_forces[h].is_pin, held[h].is_pin);
            EXPECT_EQ(frame.holding_forces[h].index, held[h].index);
        }
        forces.push_back(frame.holding_forces[0].force[1]);
    }
    EXPECT_NE(forces[0], forces[2]);
    const HostFrame now = simulator.read_frame();
    ASSERT_EQ(now.holding_forces.size(), now.positions.size());
    double sum = 0.0;
    for (std::size_t k = 1; k < now.holding_forces.size(); k += 3)
        sum += static_cast<double>(now.holding_forces[k]);
    EXPECT_NEAR(sum, forces[2], 1e-3 * std::abs(forces[2]));
    EXPECT_NE(vtu_text(make_export_topology(model_of(simulator)), now).find("Name=\"holding_force\""),
              std::string::npos);
}

// Under the names of the pages; and the step is the same with them as without.
TEST_F(StatisticsTest, TimesThePartsOfAnImplicitStep) {
    constexpr std::size_t kSteps = 3;
    using Runs = std::map<std::string, std::size_t>;
    const auto parts_of = [](std::size_t runs) {
        Runs parts;
        for (const char* part : {"detect", "linearise", "solve", "finish", "guard"})
            parts[std::string("advance_nodes.") + part] = runs;
        return parts;
    };
    for (const Backend backend : {Backend::cpu, Backend::gl}) {
        for (const CollisionResponse response : {CollisionResponse::restore, CollisionResponse::contact}) {
            Scene scene = falling_balls();
            scene.simulation.solver = SolverKind::implicit;
            scene.simulation.substeps = 1;
            scene.collision.response = response;
            SimulatorOptions options = on(backend);
            options.time_stages = true;
            Simulator plain(scene, options);
            options.time_parts = true;
            Simulator timed(scene, options);
            for (std::size_t f = 0; f < kSteps; ++f) {
                plain.advance_frame();
                timed.advance_frame();
            }
            EXPECT_EQ(plain.read_frame().positions, timed.read_frame().positions);
            Runs parts;
            for (const auto& [stage, times] : timed.take_stage_times()) {
                if (stage.find('.') != stage.npos) parts[stage] = times.size();
                if (stage == "advance_nodes") {
                    EXPECT_EQ(times.size(), kSteps);
                }
            }
            // A device launches more tries than a step may need.
            const bool has_tries = backend == Backend::gl && response == CollisionResponse::restore;
            const std::size_t runs = has_tries ? parts["advance_nodes.solve"] : kSteps;
            EXPECT_GE(runs, kSteps);
            EXPECT_EQ(parts, parts_of(runs));
            for (const auto& [stage, times] : plain.take_stage_times())
                EXPECT_EQ(stage.find('.'), stage.npos);
        }
    }
}

TEST_F(StatisticsTest, StagesAreTimedWhereTheyRun) {
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

}  // namespace
}  // namespace gelatin
