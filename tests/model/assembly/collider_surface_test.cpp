#include "model/assembly/collider_surface.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <glm/geometric.hpp>
#include <string>

#include "core/file.h"
#include "gelatin/error.h"
#include "model/assembly/build_model.h"
#include "support/test_models.h"

namespace gelatin {
namespace {

ColliderDescription box(const glm::dvec3& position) {
    ColliderDescription description;
    description.shape = Shape{BoxShape{glm::dvec3(1)}};
    description.position = position;
    return description;
}

Model packed(const Scene& scene) {
    return pack_bodies({test::make_body(test::make_block({2, 2, 2}, glm::dvec3(1)))}, solid_colliders(scene),
                       {0, -9.81, 0}, make_collider_surfaces(scene));
}

Scene scene_with(std::vector<ColliderDescription> colliders) {
    Scene scene;
    scene.collision.response = CollisionResponse::contact;
    scene.colliders = std::move(colliders);
    return scene;
}

TEST(ColliderSurface, IsAnObjectWithoutMassAfterTheBodies) {
    ColliderDescription plane, resting = box({3, 0, 0}), belt = box({6, 0, 0});
    resting.rotation = {0, 0, 90};
    resting.scale = 2.0;
    belt.name = "belt";
    belt.friction = 0.9;
    belt.surface_velocity = {1, 0, 0};
    const Model model = packed(scene_with({plane, resting, belt}));
    ASSERT_EQ(model.body_count(), 1u);
    ASSERT_EQ(model.objects.size(), 3u);
    EXPECT_EQ(model.colliders.size(), 1u);  // the plane
    EXPECT_EQ(model.objects[1].name, "collider 2");
    EXPECT_EQ(model.objects[2].name, "belt");
    EXPECT_EQ(model.surfaces[1].friction, 0.9);
    EXPECT_EQ(model.surfaces[1].velocity, glm::vec3(1, 0, 0));
    EXPECT_FALSE(model.surfaces[0].moves);
    EXPECT_TRUE(model.handles.empty());
    EXPECT_EQ(model.body_node_count(), model.objects[1].nodes.first);
    const ModelObject& object = model.objects[1];
    EXPECT_EQ(object.nodes.count, 8u);
    EXPECT_EQ(object.faces.count, 12u);
    for (std::uint32_t n = object.nodes.first; n < object.nodes.end(); ++n) {
        EXPECT_EQ(model.positions[n].w, 0.0f);
        EXPECT_EQ(model.masses[n], 0.0f);
        const glm::vec3 arm = glm::vec3(model.positions[n]) - glm::vec3(3, 0, 0);
        EXPECT_NEAR(glm::length(arm), std::sqrt(3.0f), 1e-6f);
    }
    for (std::uint32_t f = object.faces.first; f < object.faces.end(); ++f) {
        const Face& face = model.faces[f];
        EXPECT_EQ(face.object, 1u);
        const auto at = [&](std::uint32_t n) { return glm::dvec3(model.positions[n]) - glm::dvec3(3, 0, 0); };
        EXPECT_GT(glm::dot(at(face.a), glm::cross(at(face.b), at(face.c))), 0.0);  // it faces outwards
    }
}

// Six times the volume that faces of the last object enclose about its nodes' mean [m^3]: negative if they
// face inwards.
double volume_of_last(const Model& model) {
    const ModelObject& object = model.objects.back();
    glm::dvec3 middle(0.0);
    for (std::uint32_t n = object.nodes.first; n < object.nodes.end(); ++n)
        middle += glm::dvec3(model.positions[n]) / static_cast<double>(object.nodes.count);
    double volume = 0.0;
    for (std::uint32_t f = object.faces.first; f < object.faces.end(); ++f) {
        const Face& face = model.faces[f];
        const auto at = [&](std::uint32_t n) { return glm::dvec3(model.positions[n]) - middle; };
        volume += glm::dot(at(face.a), glm::cross(at(face.b), at(face.c)));
    }
    return volume;
}

// The body is a cube of a metre at the origin's positive side.
TEST(ColliderSurface, FacesBodiesThatStartWithinIt) {
    const TemporaryFolder folder;
    const auto volume_of = [](const Shape& shape, const glm::dvec3& position) {
        ColliderDescription collider;
        collider.shape = shape;
        collider.position = position;
        const Model model = packed(scene_with({collider}));
        EXPECT_EQ(model.surface.triangles.size(), model.faces.size());
        return volume_of_last(model);
    };
    const std::string corners =
        "v -1 -1 -1\nv 1 -1 -1\nv 1 1 -1\nv -1 1 -1\nv -1 -1 1\nv 1 -1 1\nv 1 1 1\nv -1 1 1\n"
        "f 4 3 2 1\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 4 1 5 8\n";
    write_file(folder.path() / "bin.obj", corners);
    write_file(folder.path() / "room.obj", corners + "f 3 4 8 7\n");
    const Shape room{FileShape{folder.path() / "room.obj"}}, bin{FileShape{folder.path() / "bin.obj"}};
    const glm::dvec3 around(0.5), above(0.5, -1.0, 0.5);
    EXPECT_NEAR(volume_of(room, around), -6.0 * 8.0, 1e-9);
    EXPECT_NEAR(volume_of(BoxShape{glm::dvec3(2)}, around), -6.0 * 8.0, 1e-9);
    EXPECT_LT(volume_of(bin, around), 0.0);
    EXPECT_LT(volume_of(SphereShape{2.0, 4}, around), 0.0);
    EXPECT_GT(volume_of(BoxShape{glm::dvec3(2)}, above), 0.0) << "it stands on it, without a gap";
    EXPECT_GT(volume_of(bin, above), 0.0);
    EXPECT_GT(volume_of(BoxShape{glm::dvec3(0.2)}, around), 0.0) << "it is within the body";
    EXPECT_GT(volume_of(bin, {3.0, 0.5, 0.5}), 0.0);
}

TEST(ColliderSurface, FollowsKeyframesAboutItsPosition) {
    ColliderDescription turning = box({3, 0, 0});
    turning.keyframes = {{0.0}, {1.0, {0, 1, 0}, {0, 90, 0}}};
    const Model model = packed(scene_with({turning}));
    ASSERT_EQ(model.handles.size(), 1u);
    EXPECT_TRUE(model.surfaces[0].moves);
    EXPECT_EQ(model.handles[0].object, 1u);
    EXPECT_EQ(model.handle_nodes.size(), 8u);
    for (const HandleNode& node : model.handle_nodes) {
        const glm::dvec3 arm(node.arm);
        EXPECT_LT(glm::distance(model.handles[0].pivot + arm, glm::dvec3(model.positions[node.node])), 1e-6);
        const glm::dvec3 end = pose_at(model.handles[0], 1.0).place(arm);
        EXPECT_LT(glm::distance(end, glm::dvec3(3 + arm.z, 1 + arm.y, -arm.x)), 1e-9);
    }
}

TEST(ColliderSurface, IsSolidWithoutContact) {
    Scene scene = scene_with({ColliderDescription{}, box({3, 0, 0})});
    scene.collision.response = CollisionResponse::restore;
    const Model model = packed(scene);
    EXPECT_EQ(model.colliders.size(), 2u);
    EXPECT_EQ(model.objects.size(), 1u);
}

TEST(ColliderSurface, RefusesFilesThatCannotBeRead) {
    const TemporaryFolder folder;
    ColliderDescription collider;
    const auto error_of = [&](const std::string& name) -> std::string {
        collider.shape = Shape{FileShape{folder.path() / name}};
        collider.line = 7;
        Scene scene = scene_with({ColliderDescription{}, collider});
        scene.file = "scene.toml";
        try {
            make_collider_surfaces(scene);
        } catch (const InvalidInput& error) {
            return error.what();
        }
        return "no error";
    };
    const std::string place = folder.path().string();
    EXPECT_EQ(error_of("missing.obj"),
              "scene.toml:7: collider[1].shape.file = " + place + "/missing.obj: no such file");
    collider.name = "wall";
    EXPECT_EQ(error_of("missing.ele"), "scene.toml:7: collider.wall.shape.file = " + place +
                                           "/missing.ele: " + place + "/missing.node: no such file");
    std::filesystem::create_directory(folder.path() / "a.obj");
    EXPECT_EQ(error_of("a.obj"),
              "scene.toml:7: collider.wall.shape.file = " + place + "/a.obj: is a folder, not a file");
    write_file(folder.path() / "points.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\n");
    EXPECT_EQ(error_of("points.obj"), place + "/points.obj: has 3 vertices and no faces");
}

}  // namespace
}  // namespace gelatin
