#include "viewer/camera_controller.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <glm/vec4.hpp>

namespace gelatin::viewer {
namespace {

constexpr float kAspect = 1.5f;

CameraController controller() {
    CameraController controller;
    controller.set({.eye = {1.0f, 2.0f, 5.0f}, .target = {0.0f, 1.0f, 0.0f}, .field_of_view = 40.0f});
    return controller;
}

// Where a point shows, in heights of the picture from its centre.
glm::vec2 place_of(const render::Camera& camera, const glm::vec3& point) {
    const glm::vec4 clip = camera.projection(kAspect) * camera.view() * glm::vec4(point, 1.0f);
    return {0.5f * kAspect * clip.x / clip.w, 0.5f * clip.y / clip.w};
}

void expect_near(const glm::vec3& a, const glm::vec3& b, float bound) {
    EXPECT_LE(glm::distance(a, b), bound) << a.x << " " << a.y << " " << a.z;
}

TEST(CameraController, TakesOverACamera) {
    const render::Camera camera = controller().camera();
    expect_near(camera.eye, {1.0f, 2.0f, 5.0f}, 1e-5f);
    expect_near(camera.target, {0.0f, 1.0f, 0.0f}, 1e-5f);
    EXPECT_EQ(camera.field_of_view, 40.0f);
}

TEST(CameraController, OrbitTurnsAboutTheTarget) {
    CameraController c = controller();
    const float distance = glm::distance(c.camera().eye, c.camera().target);
    c.orbit({0.2f, -0.1f});
    expect_near(c.camera().target, {0.0f, 1.0f, 0.0f}, 1e-6f);
    EXPECT_NEAR(glm::distance(c.camera().eye, c.camera().target), distance, 1e-5f);
    // What is in front follows the pointer: the eye goes the other way.
    EXPECT_LT(c.camera().eye.x, 1.0f);
    EXPECT_GT(c.camera().eye.y, 2.0f);
    c.orbit({-0.2f, 0.1f});
    expect_near(c.camera().eye, {1.0f, 2.0f, 5.0f}, 1e-5f);
}

TEST(CameraController, OrbitStopsBeforeThePoles) {
    CameraController c = controller();
    c.orbit({0.0f, -10.0f});
    const glm::vec3 arm = c.camera().eye - c.camera().target;
    EXPECT_GT(glm::normalize(arm).y, 0.99f);
    EXPECT_GT(glm::length(glm::vec2(arm.x, arm.z)), 0.01f);
}

TEST(CameraController, PanMovesTheTargetsPlaneWithThePointer) {
    CameraController c = controller();
    c.pan({0.13f, -0.07f});
    const glm::vec2 place = place_of(c.camera(), {0.0f, 1.0f, 0.0f});
    EXPECT_NEAR(place.x, 0.13f, 1e-5f);
    EXPECT_NEAR(place.y, -0.07f, 1e-5f);
}

TEST(CameraController, ZoomKeepsWhatIsUnderThePointer) {
    CameraController c = controller();
    const glm::vec2 place(0.3f, 0.2f);
    const render::Camera before = c.camera();
    const Ray ray = c.ray(place);
    const glm::vec3 forward = glm::normalize(before.target - before.eye);
    const float depth = glm::distance(before.target, before.eye);
    const glm::vec3 point = ray.at(depth / glm::dot(ray.direction, forward));
    c.zoom(3.0f, place);
    EXPECT_LT(glm::distance(c.camera().eye, c.camera().target), 0.8f * depth);
    EXPECT_LE(glm::distance(place_of(c.camera(), point), place), 1e-5f);
    c.zoom(-3.0f, place);
    expect_near(c.camera().eye, before.eye, 1e-4f);
}

TEST(CameraController, FrameShowsAllAndNotMuchMore) {
    CameraController c = controller();
    const render::Bounds bounds{{-3.0f, 0.0f, 2.0f}, {1.0f, 2.0f, 5.0f}};
    c.frame(bounds, kAspect);
    float most = 0.0f;
    for (const glm::vec3& corner : bounds.corners()) {
        const glm::vec2 place = glm::abs(place_of(c.camera(), corner));
        most = std::max({most, place.x / kAspect, place.y});
    }
    EXPECT_LT(most, 0.5f);
    EXPECT_GT(most, 0.4f);
}

TEST(CameraController, RaysGoThroughWhatShowsThere) {
    const CameraController c = controller();
    for (const glm::vec3& point : {glm::vec3(0.7f, 0.2f, 1.0f), glm::vec3(-1.0f, 2.0f, -3.0f)}) {
        const Ray ray = c.ray(place_of(c.camera(), point));
        const glm::vec3 arm = point - ray.origin;
        EXPECT_LE(glm::length(glm::cross(arm, ray.direction)), 1e-4f);
        EXPECT_GT(glm::dot(arm, ray.direction), 0.0f);
    }
}

TEST(CameraController, KnowsWherePointsShow) {
    const CameraController c = controller();
    const glm::vec3 point(0.7f, 0.2f, 1.0f), eye = c.camera().eye;
    ASSERT_TRUE(c.place_of(point));
    EXPECT_LE(glm::distance(*c.place_of(point), place_of(c.camera(), point)), 1e-5f);
    EXPECT_FALSE(c.place_of(2.0f * eye - point)) << "behind the eye";
    EXPECT_FALSE(c.place_of(eye));
}

// As with y up, in coordinates that are turned.
TEST(CameraController, KeepsTheScenesUpAxisUp) {
    CameraController y = controller(), z;
    z.set({.eye = {1.0f, -5.0f, 2.0f}, .target = {0.0f, 0.0f, 1.0f}, .field_of_view = 40.0f}, Axis::z);
    const auto turned = [](const glm::vec3& v) { return glm::vec3(v.x, -v.z, v.y); };
    for (CameraController* c : {&y, &z}) {
        c->orbit({0.2f, -0.1f});
        c->pan({0.1f, 0.3f});
        c->zoom(2.0f, {0.1f, -0.2f});
    }
    expect_near(z.camera().eye, turned(y.camera().eye), 1e-5f);
    expect_near(z.camera().target, turned(y.camera().target), 1e-5f);
    expect_near(z.ray({0.3f, 0.1f}).direction, turned(y.ray({0.3f, 0.1f}).direction), 1e-5f);
    EXPECT_NEAR(z.right().z, 0.0f, 1e-6f);
    EXPECT_GT(z.up().z, 0.5f);
}

}  // namespace
}  // namespace gelatin::viewer
