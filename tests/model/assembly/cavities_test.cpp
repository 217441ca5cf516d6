#include "model/assembly/cavities.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <glm/common.hpp>

#include "gelatin/error.h"
#include "mesh/shapes.h"
#include "model/assembly/build_model.h"
#include "support/shells.h"

namespace gelatin::cavities_test {
namespace {

// Of two hollow boxes in one object, far from the origin, and a body before it.
Scene boxes() {
    Scene scene;
    scene.materials.emplace_back().name = "rubber";
    const auto box = test::box_shell({0.2, 0.3, 0.4}, 0.05, {2, 3, 4}, 1);
    for (const char* name : {"first", "boxes"}) {
        ObjectDescription& object = scene.objects.emplace_back();
        object.name = name;
        object.shape = MeshShape{test::joined(*box, *box, {1.0, 0.0, 0.0})};
        object.material = "rubber";
    }
    scene.objects[1].position = {0.0, 5.0, 0.0};
    return scene;
}

Region left() {
    return BoxRegion{{-0.5, 4.0, -1.0}, {0.5, 6.0, 1.0}};
}
Region right() {
    return BoxRegion{{0.5, 4.0, -1.0}, {1.5, 6.0, 1.0}};
}

std::string error_of(const std::vector<CavityDescription>& cavities,
                     std::shared_ptr<const Mesh> mesh = nullptr) {
    Scene scene = boxes();
    scene.objects[1].cavities = cavities;
    if (mesh) scene.objects[1].shape = MeshShape{std::move(mesh)};
    try {
        build_model(scene);
    } catch (const InvalidInput& error) {
        return error.what();
    }
    return "no error";
}

TEST(Cavities, RegionsSelectHollows) {
    Scene scene = boxes();
    scene.objects[1].cavities = {{.name = "air", .region = right()}, {.region = left(), .pressure = 10.0}};
    const Model model = build_model(scene);
    ASSERT_EQ(model.cavities.size(), 2u);
    EXPECT_EQ(model.objects[0].cavities.count, 0u);
    EXPECT_EQ(model.objects[1].cavities.first, 0u);
    EXPECT_EQ(model.objects[1].cavities.count, 2u);
    EXPECT_EQ(model.cavities[0].gas.name, "air");
    EXPECT_EQ(model.cavities[1].gas.name, "cavity 2");
    EXPECT_EQ(model.cavities[1].gas.pressure, 10.0);
    for (std::size_t c = 0; c < 2; ++c) {
        const Cavity& cavity = model.cavities[c];
        EXPECT_EQ(cavity.object, 1u);
        EXPECT_NEAR(cavity.rest_volume, 0.2 * 0.3 * 0.4, 1e-12);
        EXPECT_EQ(cavity.faces.size(), 2u * 2u * (2 * 3 + 3 * 4 + 4 * 2));
        // Of the right nodes: they are on the hollow's sides.
        for (const glm::uvec3& f : cavity.faces)
            for (int k = 0; k < 3; ++k) {
                const glm::dvec3 p =
                    glm::dvec3(model.positions[f[k]]) - glm::dvec3(c == 0 ? 1.0 : 0.0, 5.0, 0.0);
                const glm::dvec3 part = glm::abs(p) / glm::dvec3(0.1, 0.15, 0.2);
                EXPECT_NEAR(std::max({part.x, part.y, part.z}), 1.0, 1e-5);
            }
        EXPECT_NEAR(enclosed_volume<glm::vec4>(cavity.faces, model.positions), cavity.rest_volume, 1e-7);
    }
}

TEST(Cavities, AHollowInAFileNeedsNoRegion) {
    Scene scene = boxes();
    scene.objects[1].shape = MeshShape{test::sphere_shell(0.1, 0.2, 2, 1)};
    scene.objects[1].cavities = {{}};
    EXPECT_EQ(build_model(scene).cavities[0].gas.name, "cavity 1");
}

TEST(Cavities, ErrorsSayHowManyHollowsThereAre) {
    EXPECT_EQ(error_of({{}}),
              "object.boxes.cavity[0]: needs a region that selects a hollow: the object has 2");
    EXPECT_EQ(
        error_of({{.region = SphereRegion{{0.0, 5.0, 0.0}, 0.2}}}),
        "object.boxes.cavity[0].region: must hold one hollow whole: it holds 0 of the object's 2 (regions "
        "are in world coordinates at the start)");
    EXPECT_EQ(
        error_of({{.region = SphereRegion{{0.0, 5.0, 0.0}, 2.0}}}),
        "object.boxes.cavity[0].region: must hold one hollow whole: it holds 2 of the object's 2 (regions "
        "are in world coordinates at the start)");
    EXPECT_EQ(error_of({{.region = left()}, {.region = left()}}),
              "object.boxes.cavity[1].region: must not select the hollow of 'cavity 1', too");
    Mesh solid;
    solid.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    solid.tets = {{0, 1, 2, 3}};
    EXPECT_EQ(error_of({{}}, std::make_shared<const Mesh>(solid)),
              "object.boxes.cavity[0]: needs a hollow that the object's tets enclose: it has none");
}

// Surfaces with a hollow keep it, however they are filled.
TEST(Cavities, MeshersLeaveHollows) {
    const SurfaceMesh ball = make_sphere({1.0, 4});
    const auto count = static_cast<std::uint32_t>(ball.positions.size());
    Mesh surface;
    for (const double radius : {0.4, 0.2})
        for (const glm::dvec3& p : ball.positions) surface.vertices.push_back(radius * p);
    for (const glm::uvec3& f : ball.faces) surface.triangles.push_back(f);
    for (const glm::uvec3& f : ball.faces) surface.triangles.push_back(count + glm::uvec3(f.x, f.z, f.y));
    for (const MesherKind kind : {MesherKind::lattice, MesherKind::tetgen}) {
        Scene scene = boxes();
        scene.objects[1].shape = MeshShape{std::make_shared<const Mesh>(surface)};
        scene.objects[1].mesher.kind = kind;
        if (kind == MesherKind::lattice) scene.objects[1].mesher.nodes = 2000;
        scene.objects[1].cavities = {{}};
        EXPECT_NEAR(build_model(scene).cavities[0].rest_volume, 0.0335, 0.004);
    }
}

}  // namespace
}  // namespace gelatin::cavities_test
