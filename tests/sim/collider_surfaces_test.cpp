// Colliders that are surfaces, as users of a Simulator meet them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/file.h"
#include "gelatin/error.h"
#include "gelatin/simulator.h"
#include "sim/export_formats.h"
#include "sim/simulator_internals.h"

namespace gelatin {
namespace {

using testing::HasSubstr;

// A block on a table, which stands on a floor; a plate falls from above.
Scene table_scene() {
    Scene scene;
    scene.collision.response = CollisionResponse::contact;
    scene.materials.resize(1);
    scene.materials[0].name = "rubber";
    scene.materials[0].youngs_modulus = 1e6;
    ObjectDescription block;
    block.name = "block";
    block.material = "rubber";
    block.shape = BoxShape{glm::dvec3(0.2), glm::ivec3(2)};
    block.position = {0, 0.61, 0};
    scene.objects.push_back(block);
    ColliderDescription floor, table, plate;
    table.name = "table";
    table.shape = Shape{BoxShape{{1, 0.5, 1}}};
    table.position = {0, 0.25, 0};
    plate.shape = Shape{BoxShape{{0.1, 0.1, 0.1}}};
    plate.position = {3, 1, 0};
    plate.keyframes = {{0.0}, {1.0, {0, -0.5, 0}}};
    scene.colliders = {floor, table, plate};
    return scene;
}

SimulatorOptions cpu() {
    SimulatorOptions options;
    options.backend = Backend::cpu;
    return options;
}

TEST(ColliderSurfacesInASimulator, AreNoObjectsOfTheScene) {
    Simulator simulator(table_scene(), cpu());
    EXPECT_EQ(simulator.counts().objects, 1u);
    EXPECT_TRUE(simulator.held_nodes().empty());
    for (int frame = 0; frame < 60; ++frame) simulator.advance_frame();
    simulator.begin_statistics();
    const FrameStatistics statistics = simulator.take_statistics();
    EXPECT_EQ(statistics.volume_ratio.size(), 1u);
    ASSERT_EQ(statistics.contact_forces.size(), 1u);
    const ContactForce& force = statistics.contact_forces[0];
    EXPECT_EQ(force.object, 0u);
    EXPECT_EQ(force.collider, std::optional<std::size_t>(1));
    EXPECT_FALSE(force.other.has_value());
    EXPECT_NEAR(force.normal[1], 8.0 * 9.81, 0.8);
    const Model& model = model_of(simulator);
    const HostFrame frame = simulator.read_frame();
    const std::uint32_t plate = model.objects[2].nodes.first;
    EXPECT_NEAR(frame.positions[3 * plate + 1], model.positions[plate].y - 0.5f, 1e-5f);
    // VTU has their surfaces where they are, beside the tets of bodies.
    ASSERT_EQ(frame.contact_forces.size(), frame.positions.size());
    const ExportTopology topology = make_export_topology(model);
    EXPECT_EQ(topology.node_count, model.body_node_count() + 8 + 8);
    EXPECT_EQ(topology.cell_count, model.tets.size() + 12 + 12);
    EXPECT_THAT(vtu_text(topology, frame), HasSubstr("Name=\"contact_force\""));
    EXPECT_THAT(vtu_text(topology, frame), HasSubstr("Name=\"contact_friction\""));
    EXPECT_TRUE(frame.holding_forces.empty()) << "the plate moves, but no body is held";
    EXPECT_THAT(obj_text(topology, frame), HasSubstr("o table"));
}

TEST(ColliderSurfacesInASimulator, GoOnFromACheckpoint) {
    const TemporaryFolder folder;
    Simulator simulator(table_scene(), cpu()), resumed(table_scene(), cpu());
    for (int frame = 0; frame < 20; ++frame) simulator.advance_frame();
    simulator.save_checkpoint(folder.path() / "20.gel");
    resumed.load_checkpoint(folder.path() / "20.gel");
    EXPECT_EQ(resumed.read_frame().positions, simulator.read_frame().positions);
    resumed.advance_frame();
    EXPECT_EQ(resumed.frame(), 21);
}

// Another simulation of the scene takes over bodies, and has colliders where its own scene says.
TEST(ColliderSurfacesInASimulator, StayWhereAChangedSceneSays) {
    Simulator simulator(table_scene(), cpu());
    for (int frame = 0; frame < 10; ++frame) simulator.advance_frame();
    Scene changed = table_scene();
    changed.colliders[1].position.x = 0.2;
    Simulator next(changed, cpu());
    next.go_on_from(simulator);
    const Model& model = model_of(next);
    const std::uint32_t table = model.objects[1].nodes.first;
    EXPECT_EQ(next.read_frame().positions[3 * table], model.positions[table].x);
    EXPECT_EQ(next.read_frame().positions[1], simulator.read_frame().positions[1]);
}

TEST(ColliderSurfacesInASimulator, MayOverlapEachOtherButNoHeldBody) {
    Scene scene = table_scene();
    scene.colliders[2].position = {0.4, 0.5, 0};  // into the table
    EXPECT_NO_THROW(Simulator(scene, cpu()));
    scene.objects[0].position.y = 0.55;
    EXPECT_NO_THROW(Simulator(scene, cpu()));  // it is moved out
    scene.objects[0].pins = {HalfSpaceRegion{{0.0, 1.0, 0.0}, 100.0}};
    try {
        Simulator simulator(scene, cpu());
        FAIL() << "a body in a collider was accepted";
    } catch (const InvalidInput& error) {
        EXPECT_THAT(error.what(), HasSubstr("'block' and 'table' overlap"));
    }
}

}  // namespace
}  // namespace gelatin
