#include "viewer/projectile.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include "model/assembly/build_model.h"

namespace gelatin::viewer {
namespace {

Scene two_boxes() {
    Scene scene;
    scene.materials.emplace_back().name = "jelly";
    for (const char* name : {"box", "box 2"}) {
        ObjectDescription box;
        box.name = name;
        box.shape = BoxShape{{1.0, 1.0, 1.0}, {3, 3, 3}};
        box.material = "jelly";
        box.position = {name[3] == 0 ? 0.0 : 3.0, 1.0, 0.0};
        box.pins = {HalfSpaceRegion{{0.0, 1.0, 0.0}, 0.51}};
        scene.objects.push_back(box);
    }
    return scene;
}

TEST(Projectile, FliesAlongTheRay) {
    Scene scene = two_boxes();
    const Model model = build_model(scene);
    const Ray ray{{1.0f, 2.0f, 8.0f}, glm::normalize(glm::vec3(-0.1f, -0.1f, -1.0f))};
    const ObjectDescription thrown = make_projectile(scene, model, 1, ray, 8.0);
    EXPECT_EQ(thrown.name, "box 2 2");
    EXPECT_TRUE(thrown.pins.empty());
    EXPECT_LT(glm::length(glm::cross(glm::normalize(thrown.velocity), glm::dvec3(ray.direction))), 1e-6);
    EXPECT_GT(glm::dot(thrown.velocity, glm::dvec3(ray.direction)), 0.0);
    EXPECT_LT(glm::distance(thrown.position, glm::dvec3(ray.at(2.0f))), 0.05);

    scene.objects.push_back(make_projectile(scene, model, 0, ray, 8.0));
    EXPECT_EQ(scene.objects.back().name, "box 3") << "box 2 is taken";
    EXPECT_EQ(build_model(scene).objects.size(), 3u);
}

}  // namespace
}  // namespace gelatin::viewer
