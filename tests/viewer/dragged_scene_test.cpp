#include "viewer/dragged_scene.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include "gelatin/simulator.h"

namespace gelatin::viewer {
namespace {

// A bar with a pin at its left, another one at its right, and a handle between them.
Scene held_bar() {
    Scene scene;
    scene.materials.push_back({});
    scene.materials[0].name = "jelly";
    scene.simulation.gravity = glm::dvec3(0.0);
    ObjectDescription bar;
    bar.name = "bar";
    bar.shape = BoxShape{{0.6, 0.2, 0.2}, {3, 1, 1}};
    bar.material = "jelly";
    bar.pins = {HalfSpaceRegion{{1.0, 0.0, 0.0}, -0.29}, HalfSpaceRegion{{-1.0, 0.0, 0.0}, -0.29}};
    HandleDescription handle;
    handle.region = BoxRegion{{-0.11, -1.0, -1.0}, {-0.09, 1.0, 1.0}};
    bar.handles = {handle};
    scene.objects.push_back(bar);
    return scene;
}

SimulatorOptions on_cpu() {
    SimulatorOptions options;
    options.backend = Backend::cpu;
    return options;
}

// What is saved leads to where the user has dragged things.
TEST(DraggedScene, EndsWhereThingsWereDragged) {
    Simulator simulator(held_bar(), on_cpu());
    ASSERT_EQ(simulator.held_nodes().size(), 3u);
    const Drag aside{{0.0, 0.1, 0.0}, glm::angleAxis(0.3, glm::dvec3(1.0, 0.0, 0.0))};
    simulator.drag(0, aside);
    simulator.drag(2, {{0.2, 0.0, 0.0}});
    const Scene scene = dragged_scene(held_bar(), simulator.held_nodes());
    ASSERT_EQ(scene.objects[0].pins.size(), 1u);
    EXPECT_EQ(std::get<HalfSpaceRegion>(scene.objects[0].pins[0]).normal.x, 1.0) << "was not dragged";
    ASSERT_EQ(scene.objects[0].handles.size(), 2u);

    Simulator again(scene, on_cpu());
    for (int f = 0; f < 120; ++f) {
        simulator.advance_frame();
        again.advance_frame();
    }
    const auto before = simulator.held_nodes(), after = again.held_nodes();
    EXPECT_LT(glm::distance(after[0].center, before[0].center), 1e-9) << "the handle";
    EXPECT_NEAR(std::abs(glm::dot(after[0].drag.turn, aside.turn)), 1.0, 1e-12);
    EXPECT_LT(glm::distance(after[1].center, before[2].center), 1e-9) << "the pin at the right";
    EXPECT_LT(glm::distance(after[2].center, before[1].center), 1e-9) << "the pin at the left";
    EXPECT_NEAR(after[1].center.x, 0.5, 1e-6);
}

TEST(DraggedScene, OfWhatNobodyDragsIsTheSame) {
    const Simulator simulator(held_bar(), on_cpu());
    const Scene scene = dragged_scene(held_bar(), simulator.held_nodes());
    EXPECT_EQ(scene.objects[0].pins.size(), 2u);
    EXPECT_EQ(scene.objects[0].handles.size(), 1u);
    EXPECT_EQ(scene.objects[0].handles[0].drag.move, glm::dvec3(0.0));
}

// Pins may share nodes; what becomes of them when one is dragged can be opened again.
TEST(DraggedScene, OfPinsThatOverlapCanBeBuilt) {
    Scene overlapping = held_bar();
    overlapping.objects[0].pins[1] = HalfSpaceRegion{{1.0, 0.0, 0.0}, 0.11};
    overlapping.objects[0].handles.clear();
    Simulator simulator(overlapping, on_cpu());
    simulator.drag(1, {{0.0, 0.0, 0.1}});
    const Scene scene = dragged_scene(overlapping, simulator.held_nodes());
    EXPECT_EQ(scene.objects[0].handles.size(), 1u);
    EXPECT_NO_THROW(Simulator(scene, on_cpu()));
}

TEST(DraggedScene, LosesWhatIsReleased) {
    const Simulator simulator(held_bar(), on_cpu());
    const std::vector<HeldNodes> held = simulator.held_nodes();
    const Scene without_pin = released_scene(held_bar(), held[1]);
    ASSERT_EQ(without_pin.objects[0].pins.size(), 1u);
    EXPECT_EQ(std::get<HalfSpaceRegion>(without_pin.objects[0].pins[0]).normal.x, -1.0);
    EXPECT_EQ(without_pin.objects[0].handles.size(), 1u);
    const Scene without_handle = released_scene(held_bar(), held[0]);
    EXPECT_EQ(without_handle.objects[0].pins.size(), 2u);
    EXPECT_TRUE(without_handle.objects[0].handles.empty());
}

}  // namespace
}  // namespace gelatin::viewer
