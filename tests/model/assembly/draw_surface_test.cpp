#include "model/assembly/draw_surface.h"

#include <gtest/gtest.h>

#include "mesh/shapes.h"
#include "support/test_models.h"

namespace gelatin {
namespace {

void expect_consistent(const Model& model) {
    const DrawSurface& surface = model.surface;
    ASSERT_EQ(surface.triangles.size(), model.faces.size());
    std::vector<std::size_t> uses(surface.vertices.size(), 0);
    for (std::size_t f = 0; f < model.faces.size(); ++f) {
        const std::uint32_t nodes[3] = {model.faces[f].a, model.faces[f].b, model.faces[f].c};
        for (int k = 0; k < 3; ++k) {
            const SurfaceVertex& vertex = surface.vertices[surface.triangles[f][k]];
            EXPECT_EQ(vertex.node, nodes[k]);
            EXPECT_EQ(vertex.object, model.faces[f].object);
            ++uses[surface.triangles[f][k]];
        }
    }
    for (std::size_t v = 0; v < uses.size(); ++v) EXPECT_EQ(uses[v], surface.vertices[v].face_count);
}

// A cube's corners belong to three sides, its edges to two, and each side is smooth in itself.
TEST(DrawSurface, SplitsABoxAtItsEdges) {
    const Model model = test::make_model(test::make_body(test::make_block({2, 2, 2}, {1, 1, 1})));
    EXPECT_EQ(model.surface.vertices.size(), 6u * 9u);
    expect_consistent(model);
}

TEST(DrawSurface, LeavesABluntSurfaceWhole) {
    const SurfaceMesh sphere = make_sphere({0.5, 6});
    std::vector<glm::vec4> positions;
    for (const glm::dvec3& p : sphere.positions) positions.emplace_back(p, 1.0);
    std::vector<Face> faces;
    for (const glm::uvec3& f : sphere.faces) faces.push_back({f.x, f.y, f.z, 0});
    DrawSurface surface;
    append_draw_surface(positions, faces, {0, static_cast<std::uint32_t>(faces.size())}, 0.7, surface);
    EXPECT_EQ(surface.vertices.size(), sphere.positions.size());
}

// Its two halves have other texture coordinates, but no other light.
TEST(DrawSurface, ASeamSplitsVerticesWithOneNormal) {
    const SurfaceMesh sphere = make_sphere({0.5, 6});
    std::vector<glm::vec4> positions;
    for (const glm::dvec3& p : sphere.positions) positions.emplace_back(p, 1.0);
    std::vector<Face> faces;
    std::vector<std::array<glm::vec2, 3>> uvs;
    for (const glm::uvec3& f : sphere.faces) {
        faces.push_back({f.x, f.y, f.z, 0});
        const double x = sphere.positions[f.x].x + sphere.positions[f.y].x + sphere.positions[f.z].x;
        const glm::vec2 uv(x > 0.0 ? 1.0f : 0.0f, 0.5f);
        uvs.push_back({uv, uv, uv});
    }
    const Range all{0, static_cast<std::uint32_t>(faces.size())};
    DrawSurface surface;
    append_draw_surface(positions, faces, all, 0.7, surface, uvs);
    ASSERT_EQ(surface.uvs.size(), surface.vertices.size());
    std::vector<std::vector<std::uint32_t>> of_node(sphere.positions.size());
    for (std::uint32_t v = 0; v < surface.vertices.size(); ++v)
        of_node[surface.vertices[v].node].push_back(v);
    std::size_t split = 0;
    for (const std::vector<std::uint32_t>& vertices : of_node) {
        ASSERT_LE(vertices.size(), 2u);
        const SurfaceVertex &first = surface.vertices[vertices.front()],
                            &last = surface.vertices[vertices.back()];
        EXPECT_EQ(first.first_face, last.first_face);
        EXPECT_EQ(first.face_count, last.face_count);
        EXPECT_GE(first.face_count, 5u);
        split += vertices.size() - 1;
    }
    EXPECT_GT(split, 10u);
    EXPECT_LT(split, sphere.positions.size() / 4);
    for (std::size_t f = 0; f < faces.size(); ++f) {
        for (int k = 0; k < 3; ++k) EXPECT_EQ(surface.uvs[surface.triangles[f][k]], uvs[f][0]);
    }
}

TEST(DrawSurface, PacksSeveralObjects) {
    Body a = test::make_body(test::make_block({2, 1, 1}, {1, 1, 1}));
    Body b = test::make_body(test::make_block({1, 3, 1}, {1, 1, 1}));
    expect_consistent(pack_bodies({a, b}, {}, {}));
}

}  // namespace
}  // namespace gelatin
