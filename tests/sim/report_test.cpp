#include "sim/report.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "gelatin/version.h"
#include "model/setting_names.h"

namespace gelatin {
namespace {

using Json = nlohmann::json;

RunReport sample_report() {
    RunReport report;
    report.scene = "scenes/sample.toml";
    report.backend = "cpu";
    report.device = "a processor";
    report.settings.solver = SolverKind::rk4;
    report.settings.forces = ForceMethod::divide_and_merge;
    report.settings.frame_rate = 50.0;
    report.settings.frames = 2;
    report.substeps = 4;
    report.step_size = 0.005;
    report.counts = {2, 10, 20, 30, 40};
    report.objects = {"a", "b"};
    FrameStatistics frame;
    frame.frame = 1;
    frame.time = 0.02;
    frame.kinetic_energy = 1.5;
    frame.elastic_energy = 2.5;
    frame.potential_energy = -3.5;
    frame.momentum[1] = -7.0;
    frame.colliding_faces = 3;
    frame.contacts = 5;
    frame.deepest_penetration = 0.001;
    frame.volume_ratio = {0.9, 1.1};
    report.frames = {frame};
    report.seconds = 0.5;
    report.frame_ms = {1.0, 2.0, 3.0, 100.0};
    report.stage_ms = {{"advance_nodes", {0.25, 0.5, 0.75}}};
    return report;
}

TEST(Report, TellsWhatWasNear) {
    RunReport report = sample_report();
    report.collision.proximity_radius = 0.005;
    report.frames.push_back(report.frames[0]);
    report.frames[0].proximities = {7, 4, 1, 0.002};
    report.frames[1].proximities = ProximityStatistics{};
    const Json json = Json::parse(to_json(report));
    EXPECT_EQ(json["settings"]["proximity_radius"], 0.005);
    EXPECT_EQ(json["frames"][0]["proximities"], (Json{{"node_face", 7}, {"edge_edge", 4}, {"lost", 1}}));
    EXPECT_EQ(json["frames"][0]["nearest_gap"], 0.002);
    EXPECT_TRUE(json["frames"][1]["nearest_gap"].is_null()) << "nothing is near";
}

TEST(Report, HasTheDocumentedKeys) {
    const Json json = Json::parse(to_json(sample_report()));
    EXPECT_EQ(json,
              (Json{{"gelatin", {{"version", version()}, {"commit", commit()}}},
                    {"scene", "scenes/sample.toml"},
                    {"backend", "cpu"},
                    {"device", "a processor"},
                    {"settings",
                     {{"solver", "rk4"},
                      {"forces", "divide_and_merge"},
                      {"frame_rate", 50.0},
                      {"substeps", 4},
                      {"iterations", 10},
                      {"step_size", 0.005},
                      {"frames", 2},
                      {"broad_phase", "hierarchy"},
                      {"detection", "discrete"},
                      {"response", "restore"},
                      {"self_collision", false},
                      {"proximity_radius", nullptr},
                      {"gravity", {0.0, -9.81, 0.0}}}},
                    {"counts", {{"objects", 2}, {"nodes", 10}, {"springs", 20}, {"faces", 30}, {"tets", 40}}},
                    {"frames", Json::array({{{"frame", 1},
                                             {"time", 0.02},
                                             {"kinetic_energy", 1.5},
                                             {"elastic_energy", 2.5},
                                             {"potential_energy", -3.5},
                                             {"momentum", {0.0, -7.0, 0.0}},
                                             {"colliding_faces", 3},
                                             {"contacts", 5},
                                             {"deepest_penetration", 0.001},
                                             {"volume_ratio", {{"a", 0.9}, {"b", 1.1}}}}})},
                    {"timing",
                     {{"fps", 8.0},
                      {"frame_ms",
                       {{"median", 2.0},
                        {"mean", 26.5},
                        {"p95", 100.0},
                        {"max", 100.0},
                        {"each", {1.0, 2.0, 3.0, 100.0}}}},
                      {"stages",
                       {{"advance_nodes",
                         {{"median", 0.5}, {"mean", 0.5}, {"p95", 0.75}, {"max", 0.75}, {"runs", 3}}}}}}}}));
}

TEST(Report, TellsContactForcesByName) {
    RunReport report = sample_report();
    report.collision.response = CollisionResponse::contact;
    report.colliders = {"floor", "plate"};
    ContactForce on_floor, on_other;
    on_floor.object = 1;
    on_floor.collider = 0;
    on_floor.normal[1] = 9.5;
    on_floor.friction[0] = -2.0;
    on_floor.points = 3;
    on_other.other = 1;
    report.frames[0].contact_forces = {on_other, on_floor};
    const Json none{0.0, 0.0, 0.0};
    EXPECT_EQ(
        Json::parse(to_json(report))["frames"][0]["contact_forces"],
        (Json::array({{{"object", "a"}, {"from", "b"}, {"normal", none}, {"friction", none}, {"points", 0}},
                      {{"object", "b"},
                       {"from", "floor"},
                       {"normal", {0.0, 9.5, 0.0}},
                       {"friction", {-2.0, 0.0, 0.0}},
                       {"points", 3}}})));
}

TEST(Report, TellsWhatPinsAndHandlesExert) {
    RunReport report = sample_report();
    HoldingForce of_pin{1, true, 0, {}, {}}, of_handle{0, false, 2, {}, {}};
    of_pin.force[1] = 9.5;
    of_handle.torque[2] = -4.0;
    report.frames[0].holding_forces = {of_handle, of_pin};
    const Json none{0.0, 0.0, 0.0};
    EXPECT_EQ(Json::parse(to_json(report))["frames"][0]["holding_forces"],
              (Json::array({{{"object", "a"}, {"handle", 2}, {"force", none}, {"torque", {0.0, 0.0, -4.0}}},
                            {{"object", "b"}, {"pin", 0}, {"force", {0.0, 9.5, 0.0}}, {"torque", none}}})));
}

TEST(Report, OfNoFramesIsStillWhole) {
    RunReport report;
    report.seconds = 0.0;
    const Json json = Json::parse(to_json(report));
    EXPECT_EQ(json["frames"], Json::array());
    EXPECT_EQ(json["timing"]["fps"], 0.0);
    EXPECT_EQ(json["timing"]["frame_ms"]["median"], 0.0);
}

TEST(Report, KeepsNamesThatAreNotUtf8FromBreakingIt) {
    RunReport report;
    report.scene = "sc\xe8ne.toml";
    EXPECT_EQ(Json::parse(to_json(report))["scene"], "sc\xef\xbf\xbdne.toml");
}

TEST(Report, PercentileIsTheNearestRank) {
    EXPECT_EQ(percentile({}, 0.5), 0.0);
    EXPECT_EQ(percentile({7.0}, 0.5), 7.0);
    EXPECT_EQ(percentile({4.0, 1.0, 3.0, 2.0}, 0.5), 2.0);
    EXPECT_EQ(percentile({4.0, 1.0, 3.0, 2.0}, 0.95), 4.0);
    EXPECT_EQ(percentile({4.0, 1.0, 3.0, 2.0}, 0.0), 1.0);
}

TEST(Report, NamesSolversAsSceneFilesDo) {
    EXPECT_STREQ(name_of(SolverKind::explicit_euler), "explicit_euler");
    EXPECT_STREQ(name_of(SolverKind::semi_implicit_euler), "semi_implicit_euler");
    EXPECT_STREQ(name_of(SolverKind::midpoint), "midpoint");
    EXPECT_STREQ(name_of(SolverKind::rk4), "rk4");
    EXPECT_STREQ(name_of(ForceMethod::fused), "fused");
    EXPECT_STREQ(name_of(ForceMethod::divide_and_merge), "divide_and_merge");
}

}  // namespace
}  // namespace gelatin
