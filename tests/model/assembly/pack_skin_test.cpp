#include "model/assembly/pack_skin.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <glm/geometric.hpp>
#include <set>

#include "mesh/shapes.h"
#include "support/test_models.h"

namespace gelatin {
namespace {

// A block with a ball around it as its skin.
Body ball_over_block(const glm::dvec3& place) {
    Body body = test::make_body(test::make_block({3, 4, 3}, {1, 1, 1}, 0.3));
    const SurfaceMesh ball = make_sphere({0.8, 5});
    SurfaceMesh around = ball;
    for (glm::dvec3& p : around.positions) p += 0.5;
    CarriedSurface carried = carry_surface(around, body.mesh);
    body.skin = std::make_shared<const ShapeSkin>(
        ShapeSkin{ball.faces, std::move(carried.vertices), carried.skin_to_hull});
    for (glm::dvec3& p : body.mesh.positions) p = 2.0 * p + place;
    body.scale = 2.0;
    return body;
}

ColliderSurface table() {
    SurfaceMesh mesh = make_box({});
    for (glm::dvec3& p : mesh.positions) p.y -= 5.0;
    return {"table", mesh, {}};
}

Model three_objects() {
    const Body plain = test::make_body(test::make_block({2, 2, 2}, {1, 1, 1}));
    return pack_bodies({plain, ball_over_block({3, 0, 0}), plain}, {}, glm::dvec3(0.0), {table()});
}

std::vector<glm::vec4> points_of(const Model& model) {
    return carry_skin(model.skin.points, std::span(model.positions));
}

TEST(PackSkin, WithoutASurfaceOfItsOwnNothingHasASkin) {
    const Model model = test::make_model(test::make_body(test::make_block({2, 2, 2}, {1, 1, 1})));
    EXPECT_TRUE(model.skin.is_empty());
    EXPECT_TRUE(model.skin.points.empty());
    EXPECT_TRUE(model.skin.surface.vertices.empty());
}

// Nodes have got another order, the body another place and size.
TEST(PackSkin, ASurfaceIsWhereItsBodyIs) {
    const Model model = three_objects();
    const SkinObject& own = model.skin.objects.at(1);
    const SurfaceMesh ball = make_sphere({0.8, 5});
    ASSERT_EQ(own.points.count, ball.positions.size());
    ASSERT_EQ(own.faces.count, ball.faces.size());
    const std::vector<glm::vec4> points = points_of(model);
    for (std::size_t v = 0; v < ball.positions.size(); ++v) {
        const glm::dvec3 expected = 2.0 * (ball.positions[v] + 0.5) + glm::dvec3(3, 0, 0);
        EXPECT_LT(glm::distance(glm::dvec3(points[own.points.first + v]), expected), 3e-6);
    }
    for (std::uint32_t f = 0; f < own.faces.count; ++f) {
        const Face& face = model.skin.faces[own.faces.first + f];
        EXPECT_EQ(glm::uvec3(face.a, face.b, face.c) - own.points.first, ball.faces[f]);
        EXPECT_EQ(face.object, 1u);
    }
    EXPECT_GT(own.distance, 0.5);
}

TEST(PackSkin, AllOthersHaveTheirHulls) {
    const Model model = three_objects();
    const std::vector<glm::vec4> points = points_of(model);
    ASSERT_EQ(model.skin.objects.size(), 4u);
    for (const std::size_t o : {std::size_t{0}, std::size_t{2}, std::size_t{3}}) {
        const SkinObject& drawn = model.skin.objects[o];
        const ModelObject& object = model.objects[o];
        EXPECT_EQ(drawn.distance, 0.0);
        ASSERT_EQ(drawn.faces.count, object.faces.count);
        EXPECT_EQ(drawn.points.count, o == 3 ? 8u : 26u);
        for (std::uint32_t f = 0; f < drawn.faces.count; ++f) {
            const Face& face = model.skin.faces[drawn.faces.first + f];
            const Face& hull = model.faces[object.faces.first + f];
            EXPECT_EQ(face.object, o);
            EXPECT_EQ(glm::vec3(points[face.a]), glm::vec3(model.positions[hull.a]));
            EXPECT_EQ(glm::vec3(points[face.b]), glm::vec3(model.positions[hull.b]));
            EXPECT_EQ(glm::vec3(points[face.c]), glm::vec3(model.positions[hull.c]));
        }
    }
}

TEST(PackSkin, TheSurfaceToDrawIsThatOfAllFaces) {
    const Model model = three_objects();
    const DrawSurface& surface = model.skin.surface;
    ASSERT_EQ(surface.triangles.size(), model.skin.faces.size());
    for (std::size_t f = 0; f < surface.triangles.size(); ++f) {
        const Face& face = model.skin.faces[f];
        const glm::uvec3 corners(face.a, face.b, face.c);
        for (int k = 0; k < 3; ++k) {
            const SurfaceVertex& vertex = surface.vertices.at(surface.triangles[f][k]);
            EXPECT_EQ(vertex.node, corners[k]);
            EXPECT_EQ(vertex.object, face.object);
        }
    }
    // The ball has no crease, the block's 26 points are at eight corners, twelve edges and six sides.
    EXPECT_EQ(surface.vertices.size(), 252u + 2u * (8u * 3u + 12u * 2u + 6u) + 8u * 3u);
}

// Every third face is red, every third one has a picture.
Body painted_ball(const glm::dvec3& place) {
    Body body = ball_over_block(place);
    ShapeSkin skin = *body.skin;
    const auto picture = std::make_shared<const std::string>("bytes");
    skin.look.materials = {{"red", {1, 0, 0}, "", nullptr}, {"picture", glm::vec3(1.0f), "a.png", picture}};
    for (std::uint32_t f = 0; f < skin.faces.size(); ++f) {
        skin.look.face_materials.push_back(f % 3 == 2 ? SurfaceLook::kNone : f % 3);
        const glm::vec2 uv(0.25f * static_cast<float>(f % 2), 0.5f);
        skin.look.corner_uvs.push_back({uv, uv, uv});
    }
    body.skin = std::make_shared<const ShapeSkin>(skin);
    return body;
}

TEST(PackSkin, TrianglesOfAMaterialAreTogetherAtTheEnd) {
    const Body plain = test::make_body(test::make_block({2, 2, 2}, {1, 1, 1}));
    const Model model = pack_bodies({plain, painted_ball({3, 0, 0}), plain}, {}, glm::dvec3(0.0));
    const Skin& skin = model.skin;
    ASSERT_EQ(skin.look.materials.size(), 2u);
    ASSERT_EQ(skin.look.face_materials.size(), skin.faces.size());
    ASSERT_EQ(skin.look.corner_uvs.size(), skin.faces.size());
    ASSERT_EQ(skin.surface.uvs.size(), skin.surface.vertices.size());
    ASSERT_EQ(skin.surface.materials.size(), 2u);
    const Range first = skin.surface.materials[0].triangles, second = skin.surface.materials[1].triangles;
    EXPECT_EQ(second.first, first.end());
    EXPECT_EQ(second.end(), skin.surface.triangles.size());
    EXPECT_EQ(first.count, skin.objects[1].faces.count / 3 + 1);
    EXPECT_EQ(skin.surface.materials[1].material, 1u);
    for (std::uint32_t t = first.first; t < second.end(); ++t)
        EXPECT_EQ(skin.surface.vertices[skin.surface.triangles[t].x].object, 1u);
    // Each face is there once, with its own corners and coordinates.
    std::multiset<std::array<std::uint32_t, 3>> drawn, expected;
    for (const glm::uvec3& t : skin.surface.triangles) {
        const auto point = [&](std::uint32_t corner) { return skin.surface.vertices[corner].node; };
        drawn.insert({point(t.x), point(t.y), point(t.z)});
    }
    for (const Face& f : skin.faces) expected.insert({f.a, f.b, f.c});
    EXPECT_EQ(drawn, expected);
}

TEST(PackSkin, CopiesShareMaterialsAndAColourReplacesThem) {
    Body blue = painted_ball({6, 0, 0});
    blue.color = {0, 0, 1};
    const Model model =
        pack_bodies({painted_ball({0, 0, 0}), painted_ball({3, 0, 0}), blue}, {}, glm::dvec3(0.0));
    const SurfaceLook& look = model.skin.look;
    EXPECT_EQ(look.materials.size(), 3u) << "their images differ, red is the same";
    const SkinObject& last = model.skin.objects[2];
    for (std::uint32_t f = last.faces.first; f < last.faces.end(); ++f)
        EXPECT_EQ(look.face_materials[f], SurfaceLook::kNone);
    EXPECT_EQ(look.corner_uvs.size(), model.skin.faces.size());
}

}  // namespace
}  // namespace gelatin
