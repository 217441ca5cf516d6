#include "render/camera.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec4.hpp>
#include <vector>

namespace gelatin::render {
namespace {

// Where points land in the picture: x and y in [-1, 1] are inside.
glm::vec3 projected_by(const Camera& camera, float aspect, const glm::vec3& point) {
    const glm::vec4 clip = camera.projection(aspect) * camera.view() * glm::vec4(point, 1.0f);
    return glm::vec3(clip) / clip.w;
}

std::vector<glm::vec3> corners(const Bounds& bounds) {
    std::vector<glm::vec3> all;
    for (int i = 0; i < 8; ++i) {
        all.emplace_back(i & 1 ? bounds.max.x : bounds.min.x, i & 2 ? bounds.max.y : bounds.min.y,
                         i & 4 ? bounds.max.z : bounds.min.z);
    }
    return all;
}

TEST(CameraTest, TargetIsInTheMiddleOfThePicture) {
    const Camera camera{{3.0f, 2.0f, 5.0f}, {0.5f, -0.25f, 1.0f}, 40.0f};
    const glm::vec3 at = projected_by(camera, 1.5f, camera.target);
    EXPECT_NEAR(at.x, 0.0f, 1e-5f);
    EXPECT_NEAR(at.y, 0.0f, 1e-5f);
}

TEST(CameraTest, FieldOfViewIsVertical) {
    const Camera camera{{0.0f, 0.0f, 10.0f}, {0.0f, 0.0f, 0.0f}, 60.0f};
    const float top = 10.0f * std::tan(std::acos(-1.0f) / 6.0f);
    EXPECT_NEAR(projected_by(camera, 2.0f, {0.0f, top, 0.0f}).y, 1.0f, 1e-5f);
    EXPECT_NEAR(projected_by(camera, 2.0f, {2.0f * top, 0.0f, 0.0f}).x, 1.0f, 1e-5f);
}

TEST(CameraTest, LooksStraightDownWithoutBreaking) {
    const Camera camera{{0.0f, 5.0f, 0.0f}, {0.0f, 0.0f, 0.0f}, 35.0f};
    const glm::vec3 at = projected_by(camera, 1.0f, {0.5f, 0.0f, 0.0f});
    EXPECT_TRUE(std::isfinite(at.x) && std::isfinite(at.y));
    EXPECT_GT(at.x, 0.1f);
}

TEST(CameraTest, FramesWideTallAndFlatBoundsTightly) {
    for (const glm::vec3& size :
         {glm::vec3(4, 1, 1), glm::vec3(1, 6, 1), glm::vec3(3, 0, 3), glm::vec3(1e-3f)}) {
        for (const float aspect : {16.0f / 9.0f, 1.0f, 0.5f}) {
            const Bounds bounds{glm::vec3(1, 2, 3) - 0.5f * size, glm::vec3(1, 2, 3) + 0.5f * size};
            const Camera camera = frame_bounds(bounds, aspect);
            float reach = 0.0f;
            for (const glm::vec3& corner : corners(bounds)) {
                const glm::vec3 at = projected_by(camera, aspect, corner);
                EXPECT_LT(std::abs(at.z), 1.0f) << "between the near and the far plane";
                reach = std::max({reach, std::abs(at.x), std::abs(at.y)});
            }
            EXPECT_LT(reach, 0.95f) << "there is a margin";
            EXPECT_GT(reach, 0.7f) << "the picture is used";
        }
    }
}

TEST(CameraTest, FramesFromTheFrontRightAndAbove) {
    const Camera camera = frame_bounds({glm::vec3(-1.0f), glm::vec3(1.0f)}, 1.5f);
    const glm::vec3 from = camera.eye - camera.target;
    EXPECT_GT(from.x, 0.0f);
    EXPECT_GT(from.y, 0.0f);
    EXPECT_GT(from.z, from.x);
}

TEST(BoundsTest, OfPoints) {
    const std::vector<float> points = {1, 2, 3, -1, 5, 0, 0, 0, 7};
    const Bounds bounds = bounds_of(points);
    EXPECT_EQ(bounds.min, glm::vec3(-1, 0, 0));
    EXPECT_EQ(bounds.max, glm::vec3(1, 5, 7));
    EXPECT_EQ(bounds_of({}).size(), glm::vec3(1.0f));
}

}  // namespace
}  // namespace gelatin::render
