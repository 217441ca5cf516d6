#include "mesh/lattice/solid_angles.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <random>

#include "mesh/lattice/triangles_of.h"
#include "mesh/mesh_samples.h"
#include "mesh/shapes.h"
#include "support/draw_vector.h"

namespace gelatin::lattice {
namespace {

constexpr double kError = 2e-3;  // as the header promises

std::vector<glm::dvec3> random_points(int count, double reach) {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> along(-reach, reach);
    std::vector<glm::dvec3> points;
    for (int k = 0; k < count; ++k) points.push_back(test::draw_vector<glm::dvec3>(along, random));
    return points;
}

double largest_error(const SurfaceMesh& surface, const std::vector<glm::dvec3>& points) {
    const FaceTree tree(surface);
    const SolidAngles fast(tree);
    const std::vector<Triangle> triangles = triangles_of(surface);
    double worst = 0.0;
    for (const glm::dvec3& p : points)
        worst = std::max(worst, std::abs(fast(p) - exact_winding_number(triangles, p)));
    return worst;
}

TEST(SolidAnglesTest, AreOneWithinAClosedSurfaceAndZeroOutside) {
    const std::vector<Triangle> box = triangles_of(cube({0.0, 0.0, 0.0}, 1.0));
    EXPECT_NEAR(exact_winding_number(box, {0.5, 0.5, 0.5}), 1.0, 1e-14);
    EXPECT_NEAR(exact_winding_number(box, {0.01, 0.02, 0.99}), 1.0, 1e-13);
    EXPECT_NEAR(exact_winding_number(box, {1.2, 0.5, 0.5}), 0.0, 1e-14);
}

// A cube's face is seen from its centre under a sixth of all directions.
TEST(SolidAnglesTest, CountSolidAngles) {
    SurfaceMesh open = cube({0.0, 0.0, 0.0}, 1.0);
    open.faces.resize(open.faces.size() - 2);
    EXPECT_NEAR(exact_winding_number(triangles_of(open), {0.5, 0.5, 0.5}), 5.0 / 6.0, 1e-14);
    for (glm::uvec3& face : open.faces) std::swap(face[0], face[1]);
    EXPECT_NEAR(exact_winding_number(triangles_of(open), {0.5, 0.5, 0.5}), -5.0 / 6.0, 1e-14);
}

TEST(SolidAnglesHeavy, OfASphereAgreeWithTheExactSum) {
    EXPECT_LT(largest_error(make_sphere({0.5, 30}), random_points(2000, 0.8)), kError);
}

TEST(SolidAnglesTest, OfSeveralNestedSurfacesAgreeWithTheExactSum) {
    SurfaceMesh surface = make_sphere({0.5, 12});
    append(surface, make_sphere({0.3, 12}));
    append(surface, cube({-0.2, -0.2, 0.1}, 0.7));
    EXPECT_LT(largest_error(surface, random_points(2000, 1.0)), kError);
}

// Faces at random cancel no errors of each other.
TEST(SolidAnglesTest, OfLooseFacesAgreeWithTheExactSum) {
    SurfaceMesh surface;
    surface.positions = random_points(3000, 0.5);
    for (std::uint32_t f = 0; f < 1000; ++f) {
        for (std::uint32_t k = 1; k < 3; ++k)  // a tenth as large as all of them
            surface.positions[3 * f + k] =
                0.9 * surface.positions[3 * f] + 0.1 * surface.positions[3 * f + k];
        surface.faces.emplace_back(3 * f, 3 * f + 1, 3 * f + 2);
    }
    EXPECT_LT(largest_error(surface, random_points(2000, 0.8)), kError);
}

// The expansion is of second order: relative to the solid angle, which is of order r^-2, its error is of
// order r^-3.
TEST(SolidAnglesTest, ErrorFallsWithTheFifthPowerOfTheDistance) {
    SurfaceMesh patch;  // few enough faces for one node
    patch.positions = {{0, 0, 0}, {1, 0, 0.2}, {0.3, 1, 0}, {0.4, 0.3, 0.6}};
    patch.faces = {{0, 1, 2}, {1, 3, 2}, {0, 3, 1}};
    std::vector<glm::dvec3> near = random_points(200, 1.0);
    for (glm::dvec3& p : near) p *= 8.0 / glm::length(p);
    std::vector<glm::dvec3> far = near;
    for (glm::dvec3& p : far) p *= 2.0;
    EXPECT_NEAR(std::log2(largest_error(patch, near) / largest_error(patch, far)), 5.0, 0.3);
}

TEST(SolidAnglesTest, OfFacesWithoutAreaAreZero) {
    SurfaceMesh surface;
    surface.positions = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}};
    surface.faces = {{0, 1, 2}, {0, 0, 0}};
    const FaceTree tree(surface);
    EXPECT_EQ(SolidAngles(tree)({0.5, 0.5, 0.5}), 0.0);
    const FaceTree empty{SurfaceMesh{}};
    EXPECT_EQ(SolidAngles(empty)({0.5, 0.5, 0.5}), 0.0);
}

}  // namespace
}  // namespace gelatin::lattice
