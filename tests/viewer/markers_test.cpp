#include "viewer/markers.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

namespace gelatin::viewer {
namespace {

CameraController marker_camera() {
    CameraController controller;
    controller.set({{0.0f, 0.0f, 4.0f}, {0.0f, 0.0f, 0.0f}, glm::degrees(2.0f * std::atan(0.5f))});
    return controller;
}

Scene scene_with(std::size_t pins, std::size_t handles) {
    Scene scene;
    ObjectDescription bar;
    bar.name = "bar";
    bar.pins.resize(pins, SphereRegion{glm::dvec3(0.0), 1.0});
    bar.handles.resize(handles);
    scene.objects.push_back(bar);
    return scene;
}

HeldNodes nodes_at(const glm::dvec3& center, bool is_pin, std::size_t index) {
    HeldNodes nodes;
    nodes.is_pin = is_pin;
    nodes.index = index;
    nodes.count = 5;
    nodes.center = nodes.pivot = center;
    return nodes;
}

TEST(Markers, ShowWhatIsHeldWhereItIs) {
    Scene scene = scene_with(1, 2);
    scene.objects[0].handles[1].keyframes = {{0.0}, {1.0, {1.0, 0.0, 0.0}}};
    std::vector<HeldNodes> held = {nodes_at({0.0, 0.0, 0.0}, false, 0), nodes_at({1.0, 0.0, 0.0}, false, 1),
                                   nodes_at({0.0, 2.0, 0.0}, true, 0)};
    held[1].target.move = {-2.0, 0.0, 0.0};
    const std::vector<Marker> markers = make_markers(held, scene, marker_camera());
    ASSERT_EQ(markers.size(), 3u);
    EXPECT_EQ(markers[0].name, "pin of 'bar'") << "a handle without keyframes is one";
    EXPECT_EQ(markers[1].name, "handle of 'bar'");
    EXPECT_EQ(markers[2].name, "pin of 'bar'");
    EXPECT_LT(glm::distance(markers[1].place, glm::vec2(0.25f, 0.0f)), 1e-5f);
    EXPECT_LT(glm::distance(markers[1].target, glm::vec2(-0.25f, 0.0f)), 1e-5f);
    EXPECT_LT(glm::distance(markers[2].place, glm::vec2(0.0f, 0.5f)), 1e-5f);
}

TEST(Markers, LeaveOutWhatIsNotHeldOrNotSeen) {
    std::vector<HeldNodes> held(3, nodes_at({0.0, 0.0, 0.0}, false, 0));
    held[0].is_released = true;
    held[1].count = 0;
    held[2].center = held[2].pivot = {0.0, 0.0, 4.5};
    EXPECT_TRUE(make_markers(held, scene_with(0, 1), marker_camera()).empty());
}

TEST(Markers, ThePointerFindsTheNearest) {
    const std::vector<Marker> markers = {{0, true, {0.0f, 0.0f}, {0.0f, 0.0f}, "a"},
                                         {1, true, {0.3f, 0.0f}, {0.05f, 0.0f}, "b"}};
    EXPECT_EQ(find_marker(markers, {0.04f, 0.0f}, 0.1f), &markers[1]);
    EXPECT_EQ(find_marker(markers, {0.02f, 0.0f}, 0.1f), &markers[0]);
    EXPECT_EQ(find_marker(markers, {0.3f, 0.0f}, 0.1f), nullptr);
    EXPECT_EQ(find_marker({}, {0.0f, 0.0f}, 0.1f), nullptr);
}

}  // namespace
}  // namespace gelatin::viewer
