#include "mesh/lattice/caps.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <random>
#include <utility>

#include "mesh/lattice/broken_surfaces.h"
#include "mesh/shapes.h"

namespace gelatin::lattice {
namespace {

bool is_balanced(const std::vector<glm::uvec3>& faces) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> uses;
    for (const glm::uvec3& face : faces) {
        for (int k = 0; k < 3; ++k) {
            const std::uint32_t a = face[k], b = face[(k + 1) % 3];
            if (a != b) uses[std::minmax(a, b)] += a < b ? 1 : -1;
        }
    }
    return std::all_of(uses.begin(), uses.end(), [](const auto& use) { return use.second == 0; });
}

std::vector<glm::uvec3> with_caps(std::vector<glm::uvec3> faces) {
    const std::vector<glm::uvec3> caps = find_caps(faces);
    faces.insert(faces.end(), caps.begin(), caps.end());
    return faces;
}

TEST(CapsTest, OfAClosedSurfaceAreNone) {
    EXPECT_TRUE(find_caps(make_sphere({0.5, 5}).faces).empty());
    EXPECT_TRUE(find_caps({}).empty());
}

TEST(CapsTest, CloseAHoleByTrianglesOfItsVertices) {
    std::vector<glm::uvec3> faces;
    constexpr std::uint32_t kCount = 64;
    for (std::uint32_t k = 0; k < kCount; ++k) faces.emplace_back(kCount, k, (k + 1) % kCount);
    const std::vector<glm::uvec3> caps = find_caps(faces);
    EXPECT_EQ(caps.size(), kCount - 2);
    EXPECT_TRUE(is_balanced(with_caps(faces)));
    std::map<std::uint32_t, int> uses;  // no fan around one vertex
    for (const glm::uvec3& cap : caps) {
        for (int k = 0; k < 3; ++k) ++uses[cap[k]];
    }
    for (const auto& [vertex, count] : uses) EXPECT_LE(count, 2 * 6);
}

TEST(CapsTest, CloseFlippedRepeatedAndMissingFaces) {
    std::mt19937 random(3);
    std::vector<glm::uvec3> faces = make_sphere({0.5, 6}).faces;
    for (glm::uvec3& face : faces) {
        if (random() % 5 == 0) std::swap(face[0], face[1]);
    }
    std::erase_if(faces, [&](const glm::uvec3&) { return random() % 5 == 0; });
    const std::vector<glm::uvec3> some(faces.begin(), faces.begin() + 40);
    faces.insert(faces.end(), some.begin(), some.end());
    EXPECT_FALSE(is_balanced(faces));
    EXPECT_TRUE(is_balanced(with_caps(faces)));
}

TEST(CapsTest, CloseBrokenSurfaces) {
    for (unsigned seed = 0; seed < 100; ++seed)
        EXPECT_TRUE(is_balanced(with_caps(BrokenSurfaces(seed).make().faces)));
}

}  // namespace
}  // namespace gelatin::lattice
