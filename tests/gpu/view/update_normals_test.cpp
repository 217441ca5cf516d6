#include "gpu/view/update_normals.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include "mesh/shapes.h"
#include "support/gl_fixture.h"
#include "support/test_models.h"

namespace gelatin {
namespace {

class UpdateNormalsTest : public test::GlTest {};

std::vector<glm::vec4> normals_of(const Model& model, const std::vector<glm::vec4>& positions) {
    const gl::Buffer<glm::vec4> buffer{std::span(positions)};
    const gl::BufferTexture texels(buffer, gl::TexelFormat::rgba32f);
    const gpu::UpdateNormals stage(model.faces, model.surface);
    stage.run(texels);
    gl::barrier(gl::Barrier::buffer_update);
    std::vector<glm::vec4> normals(model.surface.vertices.size(), glm::vec4(NAN));
    stage.vertex_normals().download(normals);
    return normals;
}

glm::dvec3 reference_normal(const Model& model, const std::vector<glm::vec4>& positions,
                            const SurfaceVertex& vertex) {
    glm::dvec3 sum(0.0);
    for (std::uint32_t k = 0; k < vertex.face_count; ++k) {
        const Face& f = model.faces[model.surface.vertex_faces[vertex.first_face + k]];
        const glm::dvec3 a(positions[f.a]), b(positions[f.b]), c(positions[f.c]);
        sum += glm::cross(b - a, c - a);
    }
    return glm::normalize(sum);
}

// Faces of 0.1 m at coordinates near 1 m: the cross product is off by some eps / 0.1.
TEST_F(UpdateNormalsTest, MatchesTheDoubleReference) {
    const Model model = test::make_lively_model();
    ASSERT_NE(model.surface.vertices.size() % 64, 0u);
    const std::vector<glm::vec4> normals = normals_of(model, model.positions);
    for (std::size_t v = 0; v < normals.size(); ++v) {
        const glm::dvec3 expected = reference_normal(model, model.positions, model.surface.vertices[v]);
        EXPECT_LT(glm::distance(glm::dvec3(normals[v]), expected), 1e-4);
    }
}

TEST_F(UpdateNormalsTest, BoxSidesAreFlatUpToTheirEdges) {
    const Model model = test::make_model(test::make_body(test::make_block({2, 3, 4}, {1, 1, 1})));
    for (const glm::vec4& n : normals_of(model, model.positions)) {
        EXPECT_FLOAT_EQ(std::max({std::abs(n.x), std::abs(n.y), std::abs(n.z)}), 1.0f);
    }
}

TEST_F(UpdateNormalsTest, ACollapsedBodyHasFiniteNormals) {
    const Model model = test::make_model(test::make_body(test::make_block({2, 2, 2}, {1, 1, 1})));
    for (const glm::vec4& n :
         normals_of(model, std::vector<glm::vec4>(model.node_count(), glm::vec4(1.0f)))) {
        EXPECT_EQ(glm::vec3(n), glm::vec3(0, 1, 0));
    }
}

// A skin's faces are between points, of which there are more than nodes.
TEST_F(UpdateNormalsTest, ASkinsNormalsAreThoseOfItsPoints) {
    Body body = test::make_body(test::make_block({2, 2, 2}, {1, 1, 1}));
    SurfaceMesh ball = make_sphere({0.7, 9});
    for (glm::dvec3& p : ball.positions) p += 0.5;
    body.skin = std::make_shared<const ShapeSkin>(
        ShapeSkin{ball.faces, carry_surface(ball, body.mesh).vertices, 0.2});
    const Model model = test::make_model(body);
    const std::vector<glm::vec4> points = carry_skin(model.skin.points, std::span(model.positions));
    const gl::Buffer<glm::vec4> buffer{std::span(points)};
    const gl::BufferTexture texels(buffer, gl::TexelFormat::rgba32f);
    const gpu::UpdateNormals stage(model.skin.faces, model.skin.surface);
    stage.run(texels);
    gl::barrier(gl::Barrier::buffer_update);
    std::vector<glm::vec4> normals(model.skin.surface.vertices.size(), glm::vec4(NAN));
    stage.vertex_normals().download(normals);
    for (std::size_t v = 0; v < normals.size(); ++v) {
        const glm::vec3 out = glm::vec3(points[model.skin.surface.vertices[v].node]) - 0.5f;
        EXPECT_GT(glm::dot(glm::vec3(normals[v]), glm::normalize(out)), 0.99f);
    }
}

}  // namespace
}  // namespace gelatin
