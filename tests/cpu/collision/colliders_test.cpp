#include "cpu/collision/colliders.h"

#include <gtest/gtest.h>

#include <numbers>
#include <random>

#include "model/assembly/build_model.h"
#include "support/draw_vector.h"

namespace gelatin {
namespace {

using cpu::Vec3;

Collider pack(const ColliderDescription& description) {
    return pack_bodies({}, {description}, {}).colliders.at(0);
}

double distance(const Collider& collider, glm::dvec3 p) {
    return cpu::surface_distance(collider, p).distance;
}

TEST(SurfaceDistance, Plane) {
    ColliderDescription d;
    d.shape = PlaneCollider{{0.0, 1.0, 0.0}, 0.5};
    EXPECT_NEAR(distance(pack(d), {3.0, 2.0, -1.0}), 1.5, 1e-12);
    EXPECT_NEAR(distance(pack(d), {3.0, 0.25, -1.0}), -0.25, 1e-12);
}

TEST(SurfaceDistance, Sphere) {
    ColliderDescription d;
    d.shape = SphereShape{0.5};
    d.position = {1.0, 2.0, 3.0};
    EXPECT_NEAR(distance(pack(d), {1.0, 4.0, 3.0}), 1.5, 1e-12);
    EXPECT_NEAR(distance(pack(d), {1.0, 2.0, 3.25}), -0.25, 1e-12);
    EXPECT_NEAR(glm::length(cpu::surface_distance(pack(d), glm::dvec3(1, 2, 3)).normal), 1.0, 1e-12)
        << "at the centre";
}

TEST(SurfaceDistance, CapsuleAlongItsTurnedAxis) {
    ColliderDescription d;
    d.shape = CapsuleShape{0.25, 2.0};
    d.rotation = {0.0, 0.0, 90.0};  // y becomes -x
    EXPECT_NEAR(distance(pack(d), {0.9, 0.5, 0.0}), 0.25, 1e-6);
    EXPECT_NEAR(distance(pack(d), {-2.0, 0.0, 0.0}), 0.75, 1e-6);
    EXPECT_NEAR(distance(pack(d), {0.0, 0.1, 0.0}), -0.15, 1e-6);
}

TEST(SurfaceDistance, BoxInItsTurnedFrame) {
    ColliderDescription d;
    d.shape = BoxShape{{2.0, 1.0, 1.0}};
    d.rotation = {0.0, 0.0, 90.0};  // two metres along y now
    const Collider box = pack(d);
    EXPECT_NEAR(distance(box, {0.0, 1.5, 0.0}), 0.5, 1e-6);
    EXPECT_NEAR(distance(box, {1.5, 0.0, 0.0}), 1.0, 1e-6);
    EXPECT_NEAR(distance(box, {0.5 + 3.0, 1.0 + 4.0, 0.0}), 5.0, 1e-6) << "from the edge";
    EXPECT_NEAR(distance(box, {0.4, 0.0, 0.0}), -0.1, 1e-6) << "out through the nearest side";
}

// The normal is the gradient of the distance, inside and outside, for every shape.
TEST(SurfaceDistance, NormalIsTheGradient) {
    ColliderDescription plane, box, sphere, capsule;
    plane.shape = PlaneCollider{glm::normalize(glm::dvec3(1, 2, 3)), 0.1};
    box.shape = BoxShape{{1.0, 0.6, 0.8}};
    sphere.shape = SphereShape{0.5};
    capsule.shape = CapsuleShape{0.3, 0.7};
    std::mt19937 random(11);
    std::uniform_real_distribution<double> coordinate(-1.0, 1.0);
    for (ColliderDescription d : {plane, box, sphere, capsule}) {
        d.rotation = {20.0, 40.0, 60.0};
        d.position = {0.1, -0.2, 0.05};
        const Collider collider = pack(d);
        for (int i = 0; i < 200; ++i) {
            const auto p = test::draw_vector<glm::dvec3>(coordinate, random);
            const auto here = cpu::surface_distance(collider, p);
            EXPECT_NEAR(distance(collider, p + 1e-7 * here.normal) - here.distance, 1e-7, 2e-9);
        }
    }
}

TEST(Bounce, ReversesTheNormalPartByTheRestitution) {
    const glm::dvec3 v = cpu::bounce<double>({0.0, -2.0, 0.0}, {0, 1, 0}, 0.0, 0.6, 0.01);
    EXPECT_NEAR(v.y, 1.2, 1e-12);
}

TEST(Bounce, FrictionSlowsByMuTimesTheNormalChange) {
    const glm::dvec3 v = cpu::bounce<double>({3.0, -2.0, 0.0}, {0, 1, 0}, 0.25, 0.5, 0.01);
    EXPECT_NEAR(v.x, 3.0 - 0.25 * 3.0, 1e-12);
    EXPECT_NEAR(v.y, 1.0, 1e-12);
}

TEST(Bounce, FrictionStopsButNeverReverses) {
    const glm::dvec3 v = cpu::bounce<double>({0.1, -2.0, 0.1}, {0, 1, 0}, 0.5, 0.0, 0.01);
    EXPECT_EQ(glm::length(v), 0.0);
}

TEST(Bounce, LeavesWhatMovesAwayAndRestsWhatIsSlow) {
    const glm::dvec3 away(1.0, 0.5, 0.0);
    EXPECT_EQ(cpu::bounce<double>(away, {0, 1, 0}, 0.5, 0.5, 0.01), away);
    EXPECT_EQ(cpu::bounce<double>({0.0, -0.005, 0.0}, {0, 1, 0}, 0.5, 0.9, 0.01).y, 0.0);
}

}  // namespace
}  // namespace gelatin
