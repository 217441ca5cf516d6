#include "model/transform.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <memory>

namespace gelatin {
namespace {

glm::dvec3 direction(Axis axis) {
    glm::dvec3 result(0.0);
    result[static_cast<int>(axis)] = 1.0;
    return result;
}

// Where the direction (x, y, z) of a shape points in a scene.
glm::dvec3 turned(const Shape& shape, Axis scene_up, std::optional<Axis> up = {}) {
    ObjectDescription object;
    object.shape = shape;
    object.up = up;
    ColliderDescription collider;
    collider.shape = shape;
    collider.up = up;
    const glm::dvec3 result = orientation_of(object, scene_up) * glm::dvec3(1, 2, 3);
    EXPECT_LT(glm::distance(result, orientation_of(collider, scene_up) * glm::dvec3(1, 2, 3)), 1e-12);
    return glm::round(1e9 * result) / 1e9;
}

TEST(Upright, MakesOneAxisTheOther) {
    for (const Axis from : {Axis::x, Axis::y, Axis::z})
        for (const Axis to : {Axis::x, Axis::y, Axis::z})
            EXPECT_LT(glm::distance(upright(from, to) * direction(from), direction(to)), 1e-12);
    // CAD programs look along +y, with x to the right.
    EXPECT_LT(glm::distance(upright(Axis::z, Axis::y) * glm::dvec3(1, 2, 3), glm::dvec3(1, 3, -2)), 1e-12);
}

TEST(Orientation, IsThatOfTheShapeInTheScene) {
    const glm::dvec3 same(1, 2, 3), to_z(1, -3, 2), to_y(1, 3, -2);
    const Shape box = BoxShape{}, obj = FileShape{"a.obj"}, mesh = MeshShape{std::make_shared<Mesh>()};
    const Shape capsule = CapsuleShape{}, text = TextShape{}, glb = FileShape{"a.GLB"},
                gltf = FileShape{"a.gltf"};
    for (const Shape& shape : {box, obj, mesh, capsule, text, glb, gltf})
        EXPECT_EQ(turned(shape, Axis::y), same);
    for (const Shape& shape : {box, obj, mesh}) EXPECT_EQ(turned(shape, Axis::z), same);
    for (const Shape& shape : {capsule, text, glb, gltf}) EXPECT_EQ(turned(shape, Axis::z), to_z);
    for (const Shape& shape : {box, obj, capsule, glb}) {
        EXPECT_EQ(turned(shape, Axis::y, Axis::z), to_y);
        EXPECT_EQ(turned(shape, Axis::z, Axis::z), same);
        EXPECT_EQ(turned(shape, Axis::z, Axis::y), to_z);
    }
}

// First upright, then rotated about the axes of the scene.
TEST(Orientation, RotatesWhatIsUpright) {
    ObjectDescription object;
    object.shape = CapsuleShape{};
    object.rotation = {0.0, 90.0, 0.0};
    EXPECT_LT(glm::distance(orientation_of(object, Axis::z) * glm::dvec3(0, 1, 0), glm::dvec3(1, 0, 0)),
              1e-12);
}

}  // namespace
}  // namespace gelatin
