#include "render/collider_props.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include "mesh/surface_repair.h"

namespace gelatin::render {
namespace {

const Bounds kPropBounds{glm::vec3(-1.0f, 0.0f, -1.0f), glm::vec3(1.0f, 2.0f, 1.0f)};

ColliderDescription collider(std::variant<PlaneCollider, Shape> shape) {
    ColliderDescription description;
    description.shape = shape;
    return description;
}

TEST(ColliderPropsTest, TheHighestFlatPlaneIsTheFloor) {
    const ColliderProps all = make_collider_props(
        {collider(PlaneCollider{{0.0, 1.0, 0.0}, -1.0}), collider(PlaneCollider{{0.0, 1.0, 0.0}, 0.25}),
         collider(PlaneCollider{{0.0, -1.0, 0.0}, -9.0})},
        kPropBounds);
    ASSERT_TRUE(all.floor_height);
    EXPECT_FLOAT_EQ(*all.floor_height, 0.25f);
    EXPECT_TRUE(all.props.empty()) << "a ceiling is not drawn";
}

TEST(ColliderPropsTest, ATiltedPlaneIsAPieceOfItFacingItsFreeSide) {
    const glm::dvec3 normal = glm::normalize(glm::dvec3(0.5, 1.0, 0.2));
    const ColliderProps all = make_collider_props({collider(PlaneCollider{normal, -0.3})}, kPropBounds);
    EXPECT_FALSE(all.floor_height);
    ASSERT_EQ(all.props.size(), 1u);
    const SurfaceMesh& piece = all.props[0];
    for (const glm::dvec3& p : piece.positions) EXPECT_NEAR(glm::dot(normal, p), -0.3, 1e-9);
    for (const glm::uvec3& f : piece.faces) {
        const glm::dvec3 a = piece.positions[f.x];
        EXPECT_GT(glm::dot(normal, glm::cross(piece.positions[f.y] - a, piece.positions[f.z] - a)), 1.0);
    }
}

TEST(ColliderPropsTest, BoxesTurnAboutXThenYThenZ) {
    ColliderDescription box = collider(BoxShape{{2.0, 4.0, 6.0}});
    box.position = {10.0, 0.0, 0.0};
    box.rotation = {90.0, 0.0, 90.0};  // x: y -> z; then z: x -> y
    const ColliderProps all = make_collider_props({box}, kPropBounds);
    ASSERT_EQ(all.props.size(), 1u);
    glm::dvec3 low(1e9), high(-1e9);
    for (const glm::dvec3& p : all.props[0].positions) {
        low = glm::min(low, p);
        high = glm::max(high, p);
    }
    // Size (2, 4, 6) turns about x to (2, 6, 4), then about z to (6, 2, 4).
    EXPECT_NEAR(glm::distance(high - low, glm::dvec3(6.0, 2.0, 4.0)), 0.0, 1e-9);
    EXPECT_NEAR(glm::distance(0.5 * (high + low), glm::dvec3(10.0, 0.0, 0.0)), 0.0, 1e-9);
}

TEST(ColliderPropsTest, SpheresAndCapsulesHaveTheirSize) {
    const ColliderProps all =
        make_collider_props({collider(SphereShape{0.5}), collider(CapsuleShape{0.25, 1.0})}, kPropBounds);
    ASSERT_EQ(all.props.size(), 2u);
    constexpr double kPi = 3.14159265358979;
    EXPECT_NEAR(signed_volume(all.props[0]), 4.0 / 3.0 * kPi * 0.125, 0.01);
    EXPECT_NEAR(signed_volume(all.props[1]), 4.0 / 3.0 * kPi * 0.015625 + kPi * 0.0625, 0.01);
}

}  // namespace
}  // namespace gelatin::render
