// What slides over a flat surface does not notice what that is made of.
#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include "gelatin/simulator.h"
#include "verify/support/attached_boxes.h"
#include "verify/support/measured_run.h"
#include "verify/support/rigid_scene.h"

namespace gelatin::seam_test {
namespace {

using namespace test;

ColliderDescription plate(const glm::dvec3& size, const glm::ivec3& segments, double x) {
    ColliderDescription plate;
    plate.shape = BoxShape{size, segments};
    plate.position = {x, -0.5 * size.y, 0.0};
    plate.friction = 0.0;
    plate.restitution = 0.0;
    return plate;
}

ObjectDescription crate(const glm::dvec3& position, double speed) {
    ObjectDescription crate = rigid("crate", BoxShape{{0.3, 0.3, 0.3}, {3, 3, 3}}, position);
    crate.velocity = {speed, 0.0, 0.0};
    return crate;
}

// @param slip in the time for which it slides (1 s), by which it lags [m]
void expect_to_slide(const Scene& scene, double speed, double slip) {
    MeasuredRun run(scene);
    const glm::dvec3 start = run.center(0);
    run.advance(1.0);
    EXPECT_NEAR(run.center(0).x - start.x, speed, slip);
    EXPECT_NEAR(run.center(0).y, start.y, 0.005);
    EXPECT_EQ(run.overlaps(), 0u);
}

// At 5 m/s, across a face a metre.
TEST(Seams, OfOneSurfaceDoNotSlow) {
    Scene scene = rigid_scene(0.0);
    scene.objects = {crate({-8.0, 0.151, 0.013}, 5.0)};
    scene.colliders = {plate({20.0, 1.0, 4.0}, {20, 1, 4}, 0.0)};
    expect_to_slide(scene, 5.0, 0.01);
}

TEST(Seams, OfTilesDoNotSlow) {
    for (const double speed : {0.5, 2.0, 8.0}) {
        Scene scene = rigid_scene(0.0);
        scene.objects = {crate({-1.2, 0.152, 0.0}, speed)};
        for (int tile = 0; tile < 4; ++tile)
            scene.colliders.push_back(plate({3.0, 0.2, 2.0}, {1, 1, 1}, 3.0 * tile - 1.5));
        expect_to_slide(scene, speed, 0.01);
    }
}

TEST(Seams, OfTilesHardlySlowSoftBlocks) {
    Scene scene = scene_of(jelly(1e6, 0.01));
    scene.collision.friction = 0.0;
    scene.objects = {box("block", {0.3, 0.3, 0.3}, {-1.2, 0.153, 0.0}, 100)};
    scene.objects[0].velocity = {2.0, 0.0, 0.0};
    for (int tile = 0; tile < 4; ++tile)
        scene.colliders.push_back(plate({3.0, 0.2, 2.0}, {1, 1, 1}, 3.0 * tile - 1.5));
    expect_to_slide(scene, 2.0, 0.05);
}

}  // namespace
}  // namespace gelatin::seam_test
