#include "mesh/lattice/winding_numbers.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "mesh/lattice/long_faces.h"
#include "mesh/mesh_samples.h"
#include "mesh/shapes.h"
#include "support/draw_vector.h"

namespace gelatin::lattice {
namespace {

double largest_error(const SurfaceMesh& surface) {
    const WindingNumbers fast(surface);
    std::vector<Triangle> triangles;
    for (const glm::uvec3& f : surface.faces)
        triangles.push_back({surface.positions[f[0]], surface.positions[f[1]], surface.positions[f[2]]});
    std::mt19937 random(7);
    std::uniform_real_distribution<double> along(-0.8, 0.8);
    double worst = 0.0;
    for (int k = 0; k < 1000; ++k) {
        const auto p = test::draw_vector<glm::dvec3>(along, random);
        worst = std::max(worst, std::abs(fast(p) - exact_winding_number(triangles, p)));
    }
    return worst;
}

constexpr double kOfCaps = 2e-3;  // as solid_angles.h promises

TEST(WindingNumbersTest, OfClosedSurfacesAreIntegers) {
    const WindingNumbers numbers(make_fan_disc(100));
    EXPECT_TRUE(numbers.is_closed());
    EXPECT_EQ(numbers({0.0, 0.0, 0.0}), 1.0);
    EXPECT_EQ(numbers({0.5, 0.5, 0.5}), 0.0);
    EXPECT_LT(largest_error(make_fan_disc(100)), 1e-9);
}

TEST(WindingNumbersTest, OfOpenSurfacesAgreeWithTheExactSum) {
    std::mt19937 random(3);
    for (SurfaceMesh surface : {make_sphere({0.5, 10}), make_fan_disc(200)}) {
        std::erase_if(surface.faces, [&](const glm::uvec3&) { return random() % 20 == 0; });
        EXPECT_FALSE(WindingNumbers(surface).is_closed());
        EXPECT_LT(largest_error(surface), kOfCaps);
        for (glm::uvec3& face : surface.faces) {
            if (random() % 20 == 0) std::swap(face[0], face[1]);
        }
        EXPECT_LT(largest_error(surface), kOfCaps);
    }
}

// The caps are then the faces themselves.
TEST(WindingNumbersTest, OfLooseFacesAgreeWithTheExactSum) {
    std::mt19937 random(3);
    std::uniform_real_distribution<double> along(-0.5, 0.5);
    SurfaceMesh surface;
    for (std::uint32_t f = 0; f < 500; ++f) {
        const auto center = test::draw_vector<glm::dvec3>(along, random);
        for (int k = 0; k < 3; ++k)
            surface.positions.push_back(center + 0.2 * test::draw_vector<glm::dvec3>(along, random));
        surface.faces.emplace_back(3 * f, 3 * f + 1, 3 * f + 2);
    }
    EXPECT_LT(largest_error(surface), kOfCaps);
}

TEST(WindingNumbersTest, WithoutFacesAreZero) {
    EXPECT_EQ(WindingNumbers(SurfaceMesh{})({0.1, 0.2, 0.3}), 0.0);
}

}  // namespace
}  // namespace gelatin::lattice
