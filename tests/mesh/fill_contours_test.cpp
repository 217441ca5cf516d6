#include "mesh/fill_contours.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <glm/geometric.hpp>
#include <set>

namespace gelatin {
namespace {

Contour make_square(double x, double y, double size) {
    return {{x, y}, {x + size, y}, {x + size, y + size}, {x, y + size}};
}

Contour reversed(Contour contour) {
    std::reverse(contour.begin(), contour.end());
    return contour;
}

double doubled_area(const FlatMesh& mesh, const glm::uvec3& t) {
    const glm::dvec2 ab = mesh.positions[t[1]] - mesh.positions[t[0]],
                     ac = mesh.positions[t[2]] - mesh.positions[t[0]];
    return ab.x * ac.y - ab.y * ac.x;
}

// Every triangle is counter-clockwise and none is flat; the areas add up to `area`.
void expect_filled(const FlatMesh& mesh, double area) {
    std::set<std::uint32_t> used;
    double sum = 0.0;
    for (const glm::uvec3& t : mesh.triangles) {
        EXPECT_GT(doubled_area(mesh, t), 1e-6);
        sum += 0.5 * doubled_area(mesh, t);
        for (int k = 0; k < 3; ++k) used.insert(t[k]);
    }
    EXPECT_NEAR(sum, area, 1e-12);
    EXPECT_EQ(used.size(), mesh.positions.size());
}

TEST(FillContours, KeepsAHoleOfOppositeWinding) {
    const FlatMesh mesh = fill_contours({make_square(0, 0, 3), reversed(make_square(1, 1, 1))});
    expect_filled(mesh, 8.0);
    EXPECT_EQ(mesh.positions.size(), 8u);
    EXPECT_EQ(mesh.triangles.size(), 8u);
}

TEST(FillContours, DoesNotMindTheWindingAsAWhole) {
    expect_filled(fill_contours({reversed(make_square(0, 0, 3)), make_square(1, 1, 1)}), 8.0);
}

TEST(FillContours, UnitesOverlappingContours) {
    const FlatMesh mesh = fill_contours({make_square(0, 0, 2), make_square(1, 1, 2)});
    expect_filled(mesh, 7.0);
    const auto is_crossing = [](const glm::dvec2& p) {
        return p == glm::dvec2(2, 1) || p == glm::dvec2(1, 2);
    };
    EXPECT_EQ(std::count_if(mesh.positions.begin(), mesh.positions.end(), is_crossing), 2);
}

// A comb: its inner corners lie on one line, so that a triangulation in the order of x has triangles without
// area.
TEST(FillContours, HasNoFlatTrianglesBetweenPointsInARow) {
    Contour comb{{0, 0}};
    const int teeth = 7;
    for (int k = 0; k < teeth; ++k) {
        comb.insert(comb.end(), {{4, 2 * k}, {4, 2 * k + 1}, {1, 2 * k + 1}, {1, 2 * k + 2}});
    }
    comb.pop_back();
    comb.pop_back();
    comb.emplace_back(0, 2 * teeth - 1);
    const FlatMesh mesh = fill_contours({comb});
    expect_filled(mesh, 2 * teeth - 1 + 3 * teeth);
}

TEST(FillContours, NothingInsideGivesNothing) {
    EXPECT_TRUE(fill_contours({}).triangles.empty());
    EXPECT_TRUE(fill_contours({{{0, 0}, {1, 1}, {2, 2}}}).triangles.empty());
}

}  // namespace
}  // namespace gelatin
