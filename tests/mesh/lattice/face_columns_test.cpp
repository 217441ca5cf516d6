#include "mesh/lattice/face_columns.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "mesh/lattice/long_faces.h"
#include "mesh/lattice/solid_angles.h"
#include "mesh/lattice/triangles_of.h"
#include "mesh/mesh_samples.h"
#include "mesh/shapes.h"
#include "support/draw_vector.h"

namespace gelatin::lattice {
namespace {

void expect_exact(const SurfaceMesh& surface) {
    const std::vector<Triangle> triangles = triangles_of(surface);
    const FaceColumns columns(triangles);
    std::mt19937 random(5);
    std::uniform_real_distribution<double> along(-0.7, 0.7);
    int inside = 0;
    for (int k = 0; k < 2000; ++k) {
        const auto p = test::draw_vector<glm::dvec3>(along, random);
        const int number = columns.winding_number(p);
        ASSERT_EQ(number, std::lround(exact_winding_number(triangles, p)));
        inside += number != 0 ? 1 : 0;
    }
    EXPECT_GT(inside, 50);
}

TEST(FaceColumnsTest, CountHowOftenASurfaceWinds) {
    expect_exact(make_sphere({0.5, 10}));
    expect_exact(make_fan_disc(300));
}

TEST(FaceColumnsTest, CountNestedCrossingAndInvertedSurfaces) {
    SurfaceMesh surface = make_sphere({0.5, 10});
    append(surface, cube({-0.2, -0.2, 0.1}, 0.7));
    SurfaceMesh cavity = make_sphere({0.3, 10});
    for (glm::uvec3& face : cavity.faces) std::swap(face[0], face[1]);
    append(surface, cavity);
    append(surface, cavity);
    expect_exact(surface);
}

// Rays through vertices and along edges and faces: 7 of each 8 points are in such a plane.
TEST(FaceColumnsTest, NoRaySlipsThroughEdges) {
    const SurfaceMesh box = make_box({{1.0, 1.0, 1.0}, {4, 4, 4}});
    const FaceColumns columns(triangles_of(box));
    for (int x = -7; x <= 7; ++x) {
        for (int y = -7; y <= 7; ++y) {
            for (int z = -7; z <= 7; ++z) {
                if (std::abs(x) == 4 || std::abs(y) == 4 || std::abs(z) == 4) continue;  // on the surface
                const bool is_inside = std::abs(x) < 4 && std::abs(y) < 4 && std::abs(z) < 4;
                ASSERT_EQ(columns.winding_number({x / 8.0, y / 8.0, z / 8.0}), is_inside ? 1 : 0);
            }
        }
    }
}

// Boxes around whole faces of this fan overlap: a sixth of them has a point.
TEST(FaceColumnsTest, FewFacesOfAFanAreCandidates) {
    const SurfaceMesh disc = make_fan_disc(4000);
    const FaceColumns columns(triangles_of(disc));
    std::mt19937 random(5);
    std::uniform_real_distribution<double> along(-0.5, 0.5);
    double sum = 0.0;
    constexpr int kPoints = 1000;
    for (int k = 0; k < kPoints; ++k)
        sum += static_cast<double>(columns.candidates(test::draw_vector<glm::dvec3>(along, random)));
    EXPECT_LT(sum / kPoints, 0.02 * static_cast<double>(disc.faces.size()));
}

TEST(FaceColumnsTest, AreEmptyWithoutFaces) {
    EXPECT_EQ(FaceColumns({}).winding_number({0.1, 0.2, 0.3}), 0);
}

}  // namespace
}  // namespace gelatin::lattice
