#include "mesh/lattice/lattice_tets.h"

#include <gtest/gtest.h>

#include <random>

#include "mesh/lattice/sound_tets.h"
#include "support/draw_vector.h"

namespace gelatin::lattice {
namespace {

// An octree with a few cells that are divided far, anywhere.
Octree random_octree(unsigned seed) {
    std::mt19937 random(seed);
    Octree octree(64);
    std::uniform_int_distribution<int> along(0, 63);
    for (int k = 0; k < 3; ++k) {
        const auto p = test::draw_vector<glm::ivec3>(along, random);
        for (std::uint32_t leaf = octree.find_leaf(p); octree[leaf].size > 2; leaf = octree.find_leaf(p))
            octree.divide(leaf);
    }
    octree.balance();
    return octree;
}

TEST(OctreeTest, BalancedLeavesDifferByAFactorOfTwoAtMost) {
    const Octree octree = random_octree(1);
    std::size_t leaves = 0;
    for (const Octree::Cell& cell : octree.cells()) {
        if (!cell.is_leaf()) continue;
        ++leaves;
        for (int d = 0; d < 27; ++d) {
            const glm::ivec3 direction(d % 3 - 1, d / 3 % 3 - 1, d / 9 - 1);
            if (direction.x != 0 && direction.y != 0 && direction.z != 0) continue;
            const glm::ivec3 beyond = cell.center() + cell.size * direction;
            if (!octree.contains(beyond)) continue;
            EXPECT_LE(octree[octree.find_leaf(beyond)].size, 2 * cell.size);
        }
    }
    EXPECT_GT(leaves, 100u);
}

TEST(OctreeTest, KeysKeepCoordinates) {
    const glm::ivec3 p(1, (1 << 20) - 1, 77);
    EXPECT_EQ(point_of(key_of(p)), p);
}

// Tets share whole faces, have no angles but those of the lattice's few shapes, and fill what is between the
// centres.
TEST(LatticeTetsTest, ShareWholeFacesAcrossSizes) {
    for (unsigned seed = 0; seed < 5; ++seed) {
        const Octree octree = random_octree(seed);
        const LatticeTets lattice = make_lattice_tets(octree);
        TetMesh mesh;
        for (const std::uint64_t key : lattice.points) mesh.positions.push_back(glm::dvec3(point_of(key)));
        for (const auto& t : lattice.tets) {
            mesh.tets.emplace_back(t[0], t[1], t[2], t[3]);
            if (tet_volume(mesh, mesh.tets.back()) < 0.0) std::swap(mesh.tets.back()[2], mesh.tets.back()[3]);
        }
        EXPECT_NEAR(least_dihedral_angle(mesh), 45.0, 1e-9);
        mesh.faces = boundary_faces(mesh.tets);
        EXPECT_EQ(mesh.faces.size() + 2 * inner_faces(mesh.tets).size(), 4 * mesh.tets.size());
        EXPECT_TRUE(is_manifold(mesh.faces));
        for (const glm::uvec3& face :
             mesh.faces) {  // only along the octree's sides, where there is no neighbour
            double nearest = 64.0;
            for (int k = 0; k < 3; ++k) {
                const glm::dvec3& p = mesh.positions[face[k]];
                for (int axis = 0; axis < 3; ++axis) nearest = std::min({nearest, p[axis], 64.0 - p[axis]});
            }
            EXPECT_EQ(nearest, 0.0);
        }
    }
}

TEST(LatticeTetsTest, EachHasATwelfthOfItsCellWhereAllHaveOneSize) {
    Octree octree(8);
    for (std::uint32_t cell = 0; cell < octree.cells().size(); ++cell) {
        if (octree[cell].size > 2) octree.divide(cell);
    }
    const LatticeTets lattice = make_lattice_tets(octree);
    TetMesh mesh;
    for (const std::uint64_t key : lattice.points) mesh.positions.push_back(glm::dvec3(point_of(key)));
    EXPECT_EQ(lattice.tets.size(), 3u * 3u * 16u * 4u);  // four around each inner face
    for (const auto& t : lattice.tets)
        EXPECT_NEAR(std::abs(tet_volume(mesh, {t[0], t[1], t[2], t[3]})), 8.0 / 12.0, 1e-12);
}

}  // namespace
}  // namespace gelatin::lattice
