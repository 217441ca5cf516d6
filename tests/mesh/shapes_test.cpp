#include "mesh/shapes.h"
#include "mesh/surface_repair.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <glm/geometric.hpp>
#include <map>
#include <numbers>

namespace gelatin {
namespace {

// Closed, oriented, of one piece and with no handle: every directed edge has one twin, and V - E + F = 2.
void expect_closed_ball(const SurfaceMesh& mesh) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> directed_edges;
    for (const glm::uvec3& face : mesh.faces) {
        for (int k = 0; k < 3; ++k) {
            ASSERT_LT(face[k], mesh.positions.size());
            ++directed_edges[{face[k], face[(k + 1) % 3]}];
        }
    }
    for (const auto& [edge, count] : directed_edges) {
        ASSERT_EQ(count, 1);
        ASSERT_EQ(directed_edges.count({edge.second, edge.first}), 1u);
    }
    EXPECT_EQ(mesh.positions.size() + mesh.faces.size(), directed_edges.size() / 2 + 2);
}

// The smallest angle's sine is at least 2 area / (longest edge)^2.
double worst_aspect(const SurfaceMesh& mesh) {
    double worst = 1.0;
    for (const glm::uvec3& face : mesh.faces) {
        const glm::dvec3 a = mesh.positions[face[0]], b = mesh.positions[face[1]],
                         c = mesh.positions[face[2]];
        const double longest = std::max({glm::distance(a, b), glm::distance(b, c), glm::distance(c, a)});
        worst = std::min(worst, glm::length(glm::cross(b - a, c - a)) / (longest * longest));
    }
    return worst;
}

TEST(Sphere, HasTheCountsOfItsFrequency) {
    for (const int frequency : {1, 2, 3, 20}) {
        const SurfaceMesh mesh = make_sphere({0.5, frequency});
        const auto f = static_cast<std::size_t>(frequency);
        EXPECT_EQ(mesh.positions.size(), 10 * f * f + 2);
        EXPECT_EQ(mesh.faces.size(), 20 * f * f);
        expect_closed_ball(mesh);
    }
}

TEST(Sphere, IsRoundAndFacesOutwards) {
    const SurfaceMesh mesh = make_sphere({0.7, 20});
    for (const glm::dvec3& position : mesh.positions) EXPECT_NEAR(glm::length(position), 0.7, 1e-15);
    // An inscribed polyhedron with edges h misses about h^2 / (4 R^2) of the volume: under 0.4% here.
    const double ball = 4.0 / 3.0 * std::numbers::pi * 0.7 * 0.7 * 0.7;
    EXPECT_LT(signed_volume(mesh), ball);
    EXPECT_GT(signed_volume(mesh), 0.996 * ball);
    EXPECT_GT(worst_aspect(mesh), 0.5);
}

TEST(Box, IsClosedOutwardAndCentred) {
    for (const glm::ivec3 segments : {glm::ivec3(1), glm::ivec3(2, 3, 5)}) {
        const SurfaceMesh mesh = make_box({{1.0, 2.0, 0.5}, segments});
        expect_closed_ball(mesh);
        const int quads = segments.x * segments.y + segments.y * segments.z + segments.z * segments.x;
        EXPECT_EQ(mesh.faces.size(), static_cast<std::size_t>(4 * quads));
        EXPECT_NEAR(signed_volume(mesh), 1.0, 1e-14);
        for (const glm::dvec3& position : mesh.positions) {
            EXPECT_LE(std::abs(position.x), 0.5);
            EXPECT_LE(std::abs(position.y), 1.0);
            EXPECT_LE(std::abs(position.z), 0.25);
        }
    }
}

TEST(Capsule, IsClosedOutwardAndRound) {
    for (const CapsuleShape& shape :
         {CapsuleShape{0.25, 0.5, 2}, CapsuleShape{0.3, 1.0, 16}, CapsuleShape{1, 1e-3, 5}}) {
        const SurfaceMesh mesh = make_capsule(shape);
        expect_closed_ball(mesh);
        const glm::dvec3 half(0.0, 0.5 * shape.length, 0.0);
        for (const glm::dvec3& position : mesh.positions) {
            const glm::dvec3 on_axis(0.0, std::clamp(position.y, -half.y, half.y), 0.0);
            EXPECT_NEAR(glm::distance(position, on_axis), shape.radius, 1e-15);
        }
        EXPECT_GT(signed_volume(mesh), 0.0);
    }
}

TEST(Capsule, HasEvenTrianglesAndTheVolumeOfItsRadius) {
    const CapsuleShape shape{0.3, 1.0, 16};
    const SurfaceMesh mesh = make_capsule(shape);
    const double exact =
        std::numbers::pi * shape.radius * shape.radius * (shape.length + 4.0 / 3.0 * shape.radius);
    EXPECT_LT(signed_volume(mesh), exact);
    EXPECT_GT(signed_volume(mesh), 0.99 * exact);
    EXPECT_GT(worst_aspect(mesh), 0.4);
}

}  // namespace
}  // namespace gelatin
