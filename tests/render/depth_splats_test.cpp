#include "render/depth_splats.h"

#include <epoxy/gl.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/ext/matrix_clip_space.hpp>
#include <glm/ext/matrix_transform.hpp>
#include <vector>

#include "mesh/shapes.h"
#include "render/static_mesh.h"
#include "support/gl_fixture.h"

namespace gelatin::render {
namespace {

constexpr int kSplatWidth = 50, kSplatHeight = 37;

// What a map holds at a texel: depth, and whether an edge passes so near that rounding decides.
struct Depth {
    double value = 1.0;
    bool is_certain = true;
};

double cross(const glm::dvec2& a, const glm::dvec2& b) {
    return a.x * b.y - a.y * b.x;
}

// One face in double; `at` in texels.
void add_face(const std::array<glm::dvec3, 3>& corner, const glm::dvec2& at, Depth& depth) {
    const glm::dvec2 a(corner[0]), b(corner[1]), c(corner[2]);
    const double area = cross(b - a, c - a);
    if (area <= 0.0) return;
    const glm::dvec3 weight =
        glm::dvec3(cross(c - b, at - b), cross(a - c, at - c), cross(b - a, at - a)) / area;
    const double least = std::min({weight.x, weight.y, weight.z});
    if (std::abs(least) < 1e-3) depth.is_certain = false;
    if (least < 0.0) return;
    const double value = glm::dot(weight, glm::dvec3(corner[0].z, corner[1].z, corner[2].z));
    depth.value = std::min(depth.value, std::clamp(value, 0.0, 1.0));
}

std::vector<Depth> reference(const std::vector<SurfaceMesh>& surfaces, const glm::mat4& world_to_clip) {
    std::vector<Depth> depths(static_cast<std::size_t>(kSplatWidth) * kSplatHeight);
    for (const SurfaceMesh& surface : surfaces) {
        for (const glm::uvec3& face : surface.faces) {
            std::array<glm::dvec3, 3> corner{};
            for (int k = 0; k < 3; ++k) {
                const glm::dvec3 clip =
                    glm::dmat4(world_to_clip) * glm::dvec4(surface.positions[face[k]], 1.0);
                corner[static_cast<std::size_t>(k)] =
                    (0.5 * clip + 0.5) * glm::dvec3(kSplatWidth, kSplatHeight, 1.0);
            }
            for (int y = 0; y < kSplatHeight; ++y) {
                for (int x = 0; x < kSplatWidth; ++x) {
                    add_face(corner, {x + 0.5, y + 0.5},
                             depths[static_cast<std::size_t>(y * kSplatWidth + x)]);
                }
            }
        }
    }
    return depths;
}

class DepthSplatsTest : public test::GlTest {
protected:
    // From above and in front, parts of the surfaces outside of the map.
    static glm::mat4 from_above(float near = 0.0f, float far = 4.0f) {
        return glm::ortho(-0.9f, 0.9f, -0.6f, 0.6f, near, far) *
               glm::lookAt(glm::vec3(0.3f, 2.0f, 0.4f), glm::vec3(0.0f), glm::vec3(0.0f, 0.0f, -1.0f));
    }

    static std::vector<float> map_of(DepthSplats& splats, const std::vector<SurfaceMesh>& surfaces,
                                     const glm::mat4& world_to_clip) {
        const Target map = Target::depth(kSplatWidth, kSplatHeight, GL_DEPTH_COMPONENT32);
        const StaticMesh all(surfaces), none;
        const SurfaceDraw draw(all.view()), nothing(none.view());
        // The second of two maps, the first of another size and view.
        const Target other = Target::depth(kSplatHeight, kSplatWidth, GL_DEPTH_COMPONENT32);
        const DepthMap maps[] = {{other, from_above(1.0f, 2.0f)}, {map, world_to_clip}};
        splats.draw(maps, {&draw, &nothing});
        std::vector<float> depths(static_cast<std::size_t>(kSplatWidth) * kSplatHeight, NAN);
        glBindTexture(GL_TEXTURE_2D, map.texture());
        glGetTexImage(GL_TEXTURE_2D, 0, GL_DEPTH_COMPONENT, GL_FLOAT, depths.data());
        return depths;
    }

    static void expect_like_reference(const std::vector<SurfaceMesh>& surfaces,
                                      const glm::mat4& world_to_clip) {
        DepthSplats splats;
        map_of(splats, {make_box({glm::dvec3(0.3), glm::ivec3(1)})}, world_to_clip);  // must leave no trace
        const std::vector<float> actual = map_of(splats, surfaces, world_to_clip);
        const std::vector<Depth> expected = reference(surfaces, world_to_clip);
        std::size_t certain = 0;
        for (std::size_t i = 0; i < actual.size(); ++i) {
            if (!expected[i].is_certain) continue;
            ++certain;
            EXPECT_NEAR(actual[i], expected[i].value, 1e-5)
                << "texel " << i % kSplatWidth << ", " << i / kSplatWidth;
        }
        EXPECT_GT(certain, actual.size() / 2);
    }
};

// Faces of two texels, and of half the map.
TEST_F(DepthSplatsTest, MatchesTheDoubleReference) {
    SurfaceMesh ball = make_sphere({0.4, 9});
    for (glm::dvec3& p : ball.positions) p += glm::dvec3(0.3, 0.2, 0.1);
    expect_like_reference({ball, make_box({glm::dvec3(1.1, 0.5, 2.0), glm::ivec3(1)})}, from_above());
}

TEST_F(DepthSplatsTest, ClampsWhatLiesBeforeAndBehind) {
    const SurfaceMesh ball = make_sphere({0.5, 9});
    expect_like_reference({ball}, from_above(1.8f, 4.0f));
    expect_like_reference({ball}, from_above(0.0f, 1.7f));
}

TEST_F(DepthSplatsTest, OnlyFacesThatLookAtTheLightCast) {
    DepthSplats splats;
    SurfaceMesh triangle{{{-5.0, 0.0, 5.0}, {5.0, 0.0, 5.0}, {0.0, 0.0, -5.0}}, {{0, 1, 2}}};
    const std::vector<float> facing = map_of(splats, {triangle}, from_above());
    EXPECT_LT(*std::max_element(facing.begin(), facing.end()), 1.0f);
    std::swap(triangle.faces[0].x, triangle.faces[0].y);
    const std::vector<float> away = map_of(splats, {triangle}, from_above());
    EXPECT_EQ(*std::min_element(away.begin(), away.end()), 1.0f);
}

TEST_F(DepthSplatsTest, NothingLeavesAnEmptyMap) {
    DepthSplats splats;
    const std::vector<float> depths = map_of(splats, {}, from_above());
    EXPECT_EQ(*std::min_element(depths.begin(), depths.end()), 1.0f);
}

TEST_F(DepthSplatsTest, FlatFacesCastNothing) {
    DepthSplats splats;
    const SurfaceMesh sliver{{{-1.0, 0.0, 0.0}, {0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}}, {{0, 1, 2}, {1, 1, 1}}};
    const std::vector<float> depths = map_of(splats, {sliver}, from_above());
    EXPECT_EQ(*std::min_element(depths.begin(), depths.end()), 1.0f);
}

}  // namespace
}  // namespace gelatin::render
