// Polygons become triangles: with all edges, without new vertices, none outside.
#include "mesh/surface_polygons.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <glm/geometric.hpp>
#include <map>
#include <numbers>
#include <random>

#include "mesh/fill_polygon.h"

namespace gelatin {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

SurfacePolygons one_polygon(std::vector<glm::dvec3> positions) {
    SurfacePolygons polygons;
    polygons.sizes = {static_cast<std::uint32_t>(positions.size())};
    for (std::uint32_t k = 0; k < positions.size(); ++k) polygons.corners.push_back(k);
    polygons.positions = std::move(positions);
    return polygons;
}

glm::dvec3 area_vector(const std::vector<glm::dvec3>& p, const glm::uvec3& t) {
    return cross(p[t[1]] - p[t[0]], p[t[2]] - p[t[0]]) / 2.0;
}

/// That the triangles have each edge of the outline once, and their own in pairs; that their areas have the
/// sign of the whole, and its sum: so none is outside or overlaps another one.
void expect_filled(const std::vector<glm::dvec3>& outline, const std::vector<glm::uvec3>& triangles) {
    const auto count = static_cast<std::uint32_t>(outline.size());
    ASSERT_EQ(triangles.size(), count - 2);
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
    glm::dvec3 whole(0.0);
    for (const glm::dvec3& p : outline)
        whole += cross(p, outline[static_cast<std::size_t>(&p - outline.data() + 1) % count]) / 2.0;
    double sum = 0.0;
    for (const glm::uvec3& t : triangles) {
        for (int k = 0; k < 3; ++k) {
            const std::uint32_t a = t[k], b = t[(k + 1) % 3];
            a < b ? ++edges[{a, b}] : --edges[{b, a}];
        }
        EXPECT_GE(dot(area_vector(outline, t), whole), -1e-12 * dot(whole, whole));
        sum += length(area_vector(outline, t));
    }
    EXPECT_NEAR(sum, length(whole), 1e-9 * length(whole));
    for (const auto& [edge, uses] : edges) {
        const bool is_last = edge.first == 0 && edge.second + 1 == count;
        const int expected = is_last ? -1 : edge.first + 1 == edge.second ? 1 : 0;
        EXPECT_EQ(uses, expected) << edge.first << " " << edge.second;
    }
}

glm::dvec3 tilted(double x, double y) {
    return {x - 0.3 * y + 5.0, 0.8 * y, 0.25 * x + y - 7.0};
}

TEST(FillPolygonTest, FillsStarShapedOutlines) {
    std::mt19937 random(1);
    std::uniform_real_distribution<double> radius(0.05, 1.0);
    for (int trial = 0; trial < 300; ++trial) {
        SCOPED_TRACE(trial);
        const std::size_t count = 3 + random() % 40;
        std::vector<glm::dvec3> outline;
        for (std::size_t k = 0; k < count; ++k) {
            const double angle = 2.0 * std::numbers::pi * static_cast<double>(k) / static_cast<double>(count);
            const double r = radius(random);
            outline.push_back(tilted(r * std::cos(angle), r * std::sin(angle)));
        }
        const FilledPolygon filled = fill_polygon(outline);
        EXPECT_FALSE(filled.crosses_itself);
        expect_filled(outline, filled.triangles);
    }
}

// A spiral: most of its corners see few others.
TEST(FillPolygonTest, FillsSpirals) {
    std::vector<glm::dvec3> outline;
    constexpr int kSteps = 200;
    for (int k = 0; k <= kSteps; ++k)
        outline.push_back(tilted((1.0 + 0.02 * k) * std::cos(0.1 * k), (1.0 + 0.02 * k) * std::sin(0.1 * k)));
    for (int k = kSteps; k >= 0; --k)
        outline.push_back(tilted((1.5 + 0.02 * k) * std::cos(0.1 * k), (1.5 + 0.02 * k) * std::sin(0.1 * k)));
    std::reverse(outline.begin(), outline.end());
    const FilledPolygon filled = fill_polygon(outline);
    EXPECT_FALSE(filled.crosses_itself);
    expect_filled(outline, filled.triangles);
}

// An outline that goes to a hole and back along the same line.
TEST(FillPolygonTest, FillsOutlinesWithHoles) {
    const std::vector<glm::dvec3> outline = {{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0}, {0, 0, 0},
                                             {1, 1, 0}, {1, 3, 0}, {3, 3, 0}, {3, 1, 0}, {1, 1, 0}};
    const FilledPolygon filled = fill_polygon(outline);
    EXPECT_FALSE(filled.crosses_itself);
    expect_filled(outline, filled.triangles);
    for (const glm::uvec3& t : filled.triangles) {
        const glm::dvec3 middle = (outline[t[0]] + outline[t[1]] + outline[t[2]]) / 3.0;
        const bool is_in_hole = std::abs(middle.x - 2.0) < 0.99 && std::abs(middle.y - 2.0) < 0.99;
        EXPECT_FALSE(is_in_hole && length(area_vector(outline, t)) > 1e-12);
    }
}

// Corners on straight lines: a fan would have triangles without area, and leave holes without them.
TEST(FillPolygonTest, MakesNoFlatTrianglesOfStraightLines) {
    const std::vector<glm::dvec3> square = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0},
                                            {3, 3, 0}, {2, 3, 0}, {0, 3, 0}, {0, 1, 0}};
    const FilledPolygon filled = fill_polygon(square);
    expect_filled(square, filled.triangles);
    for (const glm::uvec3& t : filled.triangles) EXPECT_GT(length(area_vector(square, t)), 0.1);
}

TEST(FillPolygonTest, SaysThatOutlinesCrossAndKeepsTheirEdges) {
    const std::vector<glm::dvec3> pentagram = [] {
        std::vector<glm::dvec3> corners;
        for (int k = 0; k < 5; ++k)
            corners.emplace_back(std::cos(0.8 * std::numbers::pi * k), std::sin(0.8 * std::numbers::pi * k),
                                 0.0);
        return corners;
    }();
    const FilledPolygon filled = fill_polygon(pentagram);
    EXPECT_TRUE(filled.crosses_itself);
    EXPECT_EQ(filled.triangles.size(), 3u);
}

// A gear of many teeth, and an outline of nonsense: neither takes the square of its size.
TEST(FillPolygonHeavy, TakesLargeOutlines) {
    std::vector<glm::dvec3> gear, nonsense;
    std::mt19937 random(2);
    for (int k = 0; k < 20000; ++k) {
        const double angle = 2.0 * std::numbers::pi * k / 20000, r = k % 4 < 2 ? 1.0 : 0.9;
        gear.emplace_back(r * std::cos(angle), r * std::sin(angle), 0.0);
        nonsense.emplace_back(random() % 1000, random() % 1000, random() % 1000);
    }
    expect_filled(gear, fill_polygon(gear).triangles);
    EXPECT_EQ(fill_polygon(nonsense).triangles.size(), nonsense.size() - 2);
}

TEST(FillPolygonTest, TakesPolygonsWithoutArea) {
    const std::vector<glm::dvec3> line = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}, {1.5, 0, 0}};
    EXPECT_EQ(fill_polygon(line).triangles.size(), 3u);
    EXPECT_EQ(fill_polygon(std::vector<glm::dvec3>(6, glm::dvec3(1.0))).triangles.size(), 4u);
}

TEST(SurfacePolygonsTest, DividesQuadsWhereBothTrianglesAreInside) {
    Notes notes;
    const std::vector<glm::dvec3> convex = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
    EXPECT_THAT(triangulate(one_polygon(convex), notes).faces,
                ElementsAre(glm::uvec3(0, 1, 2), glm::uvec3(0, 2, 3)));
    for (std::size_t first = 0; first < 4; ++first) {  // an arrow, which the diagonal to its notch divides
        std::vector<glm::dvec3> arrow = {{0, 0, 0}, {2, -2, 0}, {0.5, 0, 0}, {2, 2, 0}};
        std::rotate(arrow.begin(), arrow.begin() + static_cast<std::ptrdiff_t>(first), arrow.end());
        expect_filled(arrow, triangulate(one_polygon(arrow), notes).faces);
    }
    const std::vector<glm::dvec3> straight = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {1, 1, 0}};
    for (const glm::uvec3& face : triangulate(one_polygon(straight), notes).faces)
        EXPECT_GT(length(area_vector(straight, face)), 0.1);
    EXPECT_THAT(notes, IsEmpty());
}

TEST(SurfacePolygonsTest, KeepsTextureCoordinatesAndMaterialsOfCorners) {
    SurfacePolygons polygons =
        one_polygon({{0, 0, 0}, {2, 0, 0}, {3, 1, 0}, {2, 2, 0}, {1, 1, 0}, {0, 2, 0}});
    for (const glm::dvec3& p : polygons.positions) polygons.corner_uvs.emplace_back(p.x, 10.0 + p.y);
    polygons.polygon_materials = {3};
    Notes notes;
    const SurfaceMesh mesh = triangulate(polygons, notes);
    ASSERT_EQ(mesh.faces.size(), 4u);
    ASSERT_EQ(mesh.look.corner_uvs.size(), 4u);
    EXPECT_THAT(mesh.look.face_materials, ElementsAre(3u, 3u, 3u, 3u));
    for (std::size_t f = 0; f < 4; ++f) {
        for (int k = 0; k < 3; ++k) {
            const glm::dvec3& p = mesh.positions[mesh.faces[f][k]];
            EXPECT_EQ(mesh.look.corner_uvs[f][static_cast<std::size_t>(k)], glm::vec2(p.x, 10.0 + p.y));
        }
    }
}

TEST(SurfacePolygonsTest, SaysWhichPolygonsAreNone) {
    SurfacePolygons polygons;
    polygons.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
    polygons.corners = {0, 1, 0, 1, 1, 1, 0, 0, 1, 1, 2, 2, 0};
    polygons.sizes = {2, 4, 0, 7};
    Notes notes;
    EXPECT_THAT(triangulate(polygons, notes).faces, ElementsAre(glm::uvec3(0, 1, 2)));
    EXPECT_THAT(notes, ElementsAre("ignored faces of fewer than three different corners: 3"));
}

}  // namespace
}  // namespace gelatin
