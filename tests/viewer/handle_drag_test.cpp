#include "viewer/handle_drag.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <numbers>

namespace gelatin::viewer {
namespace {

using Kind = HandleDrag::Kind;

// The eye looks along -z; the picture shows 1 m for each metre of depth.
CameraController camera() {
    CameraController controller;
    controller.set({{0.0f, 0.0f, 4.0f}, {0.0f, 0.0f, 0.0f}, glm::degrees(2.0f * std::atan(0.5f))});
    return controller;
}

HeldNodes pin_at(const glm::dvec3& center) {
    HeldNodes nodes;
    nodes.count = 1;
    nodes.center = nodes.pivot = center;
    return nodes;
}

void expect_near(const glm::dvec3& actual, const glm::dvec3& expected, double bound = 1e-5) {
    EXPECT_LT(glm::distance(actual, expected), bound) << actual.x << " " << actual.y << " " << actual.z;
}

// A quarter of the picture's height is a metre at a depth of 4 m.
TEST(HandleDrag, MovesInThePlaneThatFacesTheEye) {
    HandleDrag drag(3, pin_at({0.0, 0.0, 0.0}), Kind::move, camera(), {0.01f, 0.0f});
    EXPECT_EQ(drag.held(), 3u);
    drag.move_pointer(camera(), {0.26f, 0.5f});
    expect_near(drag.target().move, {1.0, 2.0, 0.0});
    EXPECT_EQ(drag.target().turn, Drag().turn);
    drag.move_pointer(camera(), {0.01f, 0.0f});
    expect_near(drag.target().move, {0.0, 0.0, 0.0});
}

TEST(HandleDrag, GoesOnFromWhereItWasDragged) {
    HeldNodes nodes = pin_at({0.0, 0.0, 1.0});
    nodes.target.move = {0.0, 0.0, 1.0};  // on its way to a depth of 2 m
    HandleDrag drag(0, nodes, Kind::move, camera(), {0.0f, 0.0f});
    drag.move_pointer(camera(), {0.5f, 0.0f});
    expect_near(drag.target().move, {1.0, 0.0, 1.0});
}

TEST(HandleDrag, TheWheelTakesItAway) {
    HandleDrag drag(0, pin_at({0.0, 0.0, 0.0}), Kind::move, camera(), {0.0f, 0.0f});
    drag.scroll(camera(), 2.0f);
    expect_near(drag.target().move, {0.0, 0.0, 4.0 - 4.0 * 1.05 * 1.05});
    EXPECT_LT(drag.target().move.z, 0.0);
}

// What faces the eye follows the pointer, as it does when the view is rotated.
TEST(HandleDrag, TurnsWithThePointer) {
    const glm::dvec3 front(0.0, 0.0, 1.0);
    HandleDrag sideways(0, pin_at({0.0, 0.0, 0.0}), Kind::turn, camera(), {0.0f, 0.0f});
    sideways.move_pointer(camera(), {0.1f, 0.0f});
    EXPECT_EQ(sideways.target().move, glm::dvec3(0.0));
    const double angle = 0.1 * static_cast<double>(CameraController::kTurn);
    expect_near(sideways.target().turn * front, {std::sin(angle), 0.0, std::cos(angle)});
    HandleDrag upwards(0, pin_at({0.0, 0.0, 0.0}), Kind::turn, camera(), {0.0f, 0.0f});
    upwards.move_pointer(camera(), {0.0f, 0.1f});
    expect_near(upwards.target().turn * front, {0.0, std::sin(angle), std::cos(angle)});
    HandleDrag rolled(0, pin_at({0.0, 0.0, 0.0}), Kind::turn, camera(), {0.0f, 0.0f});
    for (int n = 0; n < 18; ++n) rolled.scroll(camera(), 1.0f);
    expect_near(rolled.target().turn * glm::dvec3(0.0, 1.0, 0.0), {1.0, 0.0, 0.0});  // clockwise
}

// A handle's nodes turn about its pivot, which keyframes may have moved.
TEST(HandleDrag, KnowsWhereTheNodesWillBe) {
    HeldNodes nodes;
    nodes.drag = {{0.0, 0.1, 0.0}, glm::angleAxis(0.5 * std::numbers::pi, glm::dvec3(0.0, 0.0, 1.0))};
    nodes.pivot = {1.0, 0.1, 0.0};
    nodes.center = {1.0, 1.1, 0.0};
    nodes.target = nodes.drag;
    expect_near(target_center(nodes), nodes.center);
    nodes.target = {};
    expect_near(target_center(nodes), {2.0, 0.0, 0.0});
}

}  // namespace
}  // namespace gelatin::viewer
