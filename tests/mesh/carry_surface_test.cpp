#include "mesh/carry_surface.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>

#include "mesh/mesh_samples.h"
#include "mesh/shapes.h"
#include "mesh/topology.h"
#include "support/test_models.h"

namespace gelatin {
namespace {

glm::dvec3 place_of(const CarriedVertex& v, const TetMesh& body) {
    glm::dvec3 sum(0.0);
    for (int k = 0; k < 4; ++k) sum += v.weights[k] * body.positions[v.nodes[k]];
    return sum;
}

double sum_of(const glm::dvec4& w) {
    return w.x + w.y + w.z + w.w;
}

double size_of(const glm::dvec4& w) {
    return sum_of(glm::abs(w));
}

TetMesh moved(TetMesh mesh, const glm::dvec3& by) {
    for (glm::dvec3& p : mesh.positions) p += by;
    return mesh;
}

// A ball of 0.4 m around the middle of a cube of a metre.
SurfaceMesh ball_in_cube() {
    SurfaceMesh ball = make_sphere({0.4, 12});
    for (glm::dvec3& p : ball.positions) p += 0.5;
    return ball;
}

TEST(CarrySurface, VerticesInsideAreInTheirTets) {
    const TetMesh body = test::make_block({4, 4, 4}, {1.0, 1.0, 1.0}, 0.3);
    const SurfaceMesh ball = ball_in_cube();
    const CarriedSurface carried = carry_surface(ball, body);
    ASSERT_EQ(carried.vertices.size(), ball.positions.size());
    for (std::size_t v = 0; v < ball.positions.size(); ++v) {
        const CarriedVertex& vertex = carried.vertices[v];
        EXPECT_LT(glm::distance(place_of(vertex, body), ball.positions[v]), 1e-14);
        EXPECT_NEAR(size_of(vertex.weights), 1.0, 1e-8) << "no weight is negative";
        EXPECT_NEAR(sum_of(vertex.weights), 1.0, 1e-14);
    }
    EXPECT_NEAR(carried.skin_to_hull, 0.5 - 0.4 / std::sqrt(3.0), 0.01) << "where the corners are near";
    EXPECT_NEAR(carried.hull_to_skin, std::sqrt(0.75) - 0.4, 0.01) << "from the corners";
}

// Whatever carries them: an affine motion of all nodes is theirs, too.
TEST(CarrySurface, VerticesOutsideContinueTheMotion) {
    const TetMesh body = test::make_block({3, 3, 3}, {1.0, 1.0, 1.0}, 0.3);
    SurfaceMesh ball = make_sphere({0.95, 6});
    for (glm::dvec3& p : ball.positions) p += 0.5;
    const CarriedSurface carried = carry_surface(ball, body);
    const glm::dmat3 map({1.2, 0.1, 0.0}, {-0.3, 0.9, 0.2}, {0.0, 0.4, 1.5});
    TetMesh later = body;
    for (glm::dvec3& p : later.positions) p = map * p;
    for (std::size_t v = 0; v < ball.positions.size(); ++v) {
        EXPECT_LT(glm::distance(place_of(carried.vertices[v], body), ball.positions[v]), 1e-13);
        EXPECT_LT(glm::distance(place_of(carried.vertices[v], later), map * ball.positions[v]), 1e-13);
    }
    EXPECT_NEAR(carried.skin_to_hull, 0.45, 0.01);
    EXPECT_LT(carried.hull_to_skin, 0.45);
}

TEST(CarrySurface, AVertexBesideAFaceIsCarriedByItsTet) {
    const TetMesh body = test::make_block({3, 3, 3}, {3.0, 3.0, 3.0});
    for (const glm::uvec3& face : body.faces) {
        const glm::dvec3 &a = body.positions[face.x], &b = body.positions[face.y],
                         &c = body.positions[face.z];
        const glm::dvec3 p = (a + b + c) / 3.0 + 0.1 * glm::normalize(glm::cross(b - a, c - a));
        const CarriedSurface carried = carry_surface({{p}, {}}, body);
        const glm::uvec4& nodes = carried.vertices[0].nodes;
        for (int corner = 0; corner < 3; ++corner) {
            EXPECT_TRUE(nodes.x == face[corner] || nodes.y == face[corner] || nodes.z == face[corner] ||
                        nodes.w == face[corner]);
        }
        EXPECT_NEAR(carried.skin_to_hull, 0.1, 1e-12);
    }
}

// A tet of 1 mm on top of a tall one: beyond it, the vertex is carried by the tall one.
TEST(CarrySurface, FlatTetsAtTheBoundaryDoNotThrowVerticesAbout) {
    TetMesh body{{{0, 0, 0}, {1, 0, 0}, {0, 0, -1}, {0.3, -1, -0.3}, {0.3, 0.001, -0.3}},
                 {{0, 1, 2, 3}, {0, 1, 2, 4}},
                 {}};
    for (glm::uvec4& tet : body.tets) {
        if (tet_volume(body, tet) < 0.0) std::swap(tet.x, tet.y);
    }
    body.faces = boundary_faces(body.tets);
    const CarriedSurface carried = carry_surface({{{0.3, 0.1, -0.3}}, {}}, body);
    EXPECT_LT(size_of(carried.vertices[0].weights), 1.5);
    EXPECT_NEAR(carried.skin_to_hull, 0.099, 1e-12);
}

TEST(CarrySurface, AnySurfaceCanBeCarried) {
    const TetMesh body = test::make_block({2, 2, 2}, {1.0, 1.0, 1.0});
    SurfaceMesh skin = cube(glm::dvec3(0.25), 0.5);
    append(skin, cube({1e6, -1e6, 3.0}, 1e-3));  // far away
    skin.faces.emplace_back(0, 0, 0);            // without area
    skin.faces.emplace_back(0, 1, 1);
    skin.positions.emplace_back(0.5);  // without a face, and a node
    const CarriedSurface carried = carry_surface(skin, body);
    ASSERT_EQ(carried.vertices.size(), skin.positions.size());
    for (std::size_t v = 0; v < skin.positions.size(); ++v)
        EXPECT_LT(glm::distance(place_of(carried.vertices[v], body), skin.positions[v]), 1e-9);
    EXPECT_NEAR(carried.skin_to_hull, std::sqrt(2.0) * 1e6, 10.0);

    const CarriedSurface none = carry_surface({}, body);
    EXPECT_TRUE(none.vertices.empty());
    EXPECT_EQ(none.skin_to_hull, 0.0);
    EXPECT_EQ(none.hull_to_skin, 0.0);
}

TEST(CarrySurface, ItsOwnBoundaryIsNowhereElse) {
    const TetMesh body = moved(test::make_block({3, 2, 4}, {0.3, 0.2, 0.4}, 0.3), {7.0, -3.0, 11.0});
    const CarriedSurface carried = carry_surface({body.positions, body.faces}, body);
    EXPECT_LT(carried.hull_to_skin, 1e-14);
    for (std::size_t v = 0; v < body.positions.size(); ++v)
        EXPECT_LT(glm::distance(place_of(carried.vertices[v], body), body.positions[v]), 1e-13);
}

TEST(CarrySurface, IsTheSameForAnyNumberOfThreads) {
    const TetMesh body = test::make_block({6, 6, 6}, {1.0, 1.0, 1.0}, 0.3);
    SurfaceMesh ball = make_sphere({0.55, 40});
    for (glm::dvec3& p : ball.positions) p += 0.5;
    const CarriedSurface many = carry_surface(ball, body);
    const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
    const CarriedSurface serial = carry_surface(ball, body);
    for (std::size_t v = 0; v < many.vertices.size(); ++v) {
        EXPECT_EQ(many.vertices[v].nodes, serial.vertices[v].nodes);
        EXPECT_EQ(many.vertices[v].weights, serial.vertices[v].weights);
    }
    EXPECT_EQ(many.skin_to_hull, serial.skin_to_hull);
    EXPECT_EQ(many.hull_to_skin, serial.hull_to_skin);
}

}  // namespace
}  // namespace gelatin
