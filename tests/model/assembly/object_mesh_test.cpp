#include "model/assembly/object_mesh.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include "core/file.h"
#include "mesh/shapes.h"
#include "mesh/tet_file.h"
#include "support/test_models.h"

namespace gelatin {
namespace {

// A ball whose hull is coarser than itself.
ObjectDescription coarse_ball() {
    ObjectDescription ball;
    ball.name = "ball";
    ball.shape = SphereShape{0.5, 12};
    ball.mesher.kind = MesherKind::lattice;
    ball.mesher.nodes = 200;
    return ball;
}

TEST(ObjectMesher, ASurfaceOfItsOwnIsInTheOrderOfItsFile) {
    ObjectMesher mesher;
    const ObjectDescription ball = coarse_ball();
    const auto skin = mesher.skin(ball);
    ASSERT_NE(skin, nullptr);
    const SurfaceMesh surface = make_sphere({0.5, 12});
    EXPECT_EQ(skin->faces, surface.faces);
    ASSERT_EQ(skin->vertices.size(), surface.positions.size());
    const TetMesh mesh = mesher.make(ball);
    for (std::size_t v = 0; v < skin->vertices.size(); ++v) {
        glm::dvec3 sum(0.0);
        for (int k = 0; k < 4; ++k)
            sum += skin->vertices[v].weights[k] * mesh.positions[skin->vertices[v].nodes[k]];
        EXPECT_LT(glm::distance(sum, surface.positions[v]), 1e-12);
    }
    EXPECT_GT(skin->distance, 1e-3);
    EXPECT_LT(skin->distance, 0.1);
}

TEST(ObjectMesher, CopiesShareTheirSkin) {
    ObjectMesher mesher;
    ObjectDescription ball = coarse_ball();
    const auto skin = mesher.skin(ball);
    ball.position = {1, 2, 3};
    ball.scale = 2.0;
    EXPECT_EQ(mesher.skin(ball), skin);
    ball.skin = false;
    EXPECT_EQ(mesher.skin(ball), nullptr) << "and those that want none have none";
}

// TetGen divides its faces, but where it is stays the same.
TEST(ObjectMesher, ASurfaceThatTheHullReproducesIsNoSkin) {
    ObjectMesher mesher;
    ObjectDescription box;
    box.shape = BoxShape{};
    box.mesher.kind = MesherKind::tetgen;
    box.mesher.max_volume = 0.01;
    ASSERT_GT(mesher.make(box).faces.size(), make_box({}).faces.size());
    EXPECT_EQ(mesher.skin(box), nullptr);
}

TEST(ObjectMesher, FilesWithTetsHaveNoSkin) {
    const TemporaryFolder folder;
    const auto file = folder.path() / "block.mesh";
    write_tets(file, test::make_block({2, 2, 2}, {1, 1, 1}));
    ObjectMesher mesher;
    ObjectDescription block;
    block.shape = FileShape{file};
    EXPECT_EQ(mesher.make(block).tets.size(), 48u);
    EXPECT_EQ(mesher.skin(block), nullptr);
}

MeshShape in_memory(const SurfaceMesh& surface) {
    return {std::make_shared<Mesh>(Mesh{surface.positions, surface.faces, {}, {}})};
}

TEST(ObjectMesher, TetsInMemoryAreThoseOfAFile) {
    const TemporaryFolder folder;
    const auto file = folder.path() / "block.mesh";
    const TetMesh block = test::make_block({2, 2, 2}, {1, 1, 1});
    write_tets(file, block);
    ObjectMesher mesher;
    ObjectDescription from_file, from_memory;
    from_file.shape = FileShape{file};
    from_memory.shape = MeshShape{std::make_shared<Mesh>(Mesh{block.positions, {}, block.tets, {}})};
    const TetMesh expected = mesher.make(from_file), made = mesher.make(from_memory);
    EXPECT_EQ(made.positions, expected.positions);
    EXPECT_EQ(made.tets, expected.tets);
    EXPECT_EQ(made.faces, expected.faces);
    EXPECT_EQ(mesher.skin(from_memory), nullptr);
}

TEST(ObjectMesher, ASurfaceInMemoryIsFilledAndHasItsSkin) {
    ObjectMesher mesher;
    ObjectDescription ball;
    ball.name = "ball";
    ball.shape = in_memory(make_sphere({0.5, 6}));
    ball.mesher.kind = MesherKind::lattice;
    ball.mesher.nodes = 400;
    ball.scale = 2.0;
    const TetMesh mesh = mesher.make(ball);
    EXPECT_NEAR(static_cast<double>(mesh.positions.size()), 400.0, 80.0);
    const auto skin = mesher.skin(ball);
    ASSERT_NE(skin, nullptr);
    EXPECT_EQ(skin->faces.size(), make_sphere({0.5, 6}).faces.size());
    ball.mesher = {};  // a size as for files
    EXPECT_NEAR(static_cast<double>(mesher.make(ball).positions.size()), 5000.0, 1000.0);
}

}  // namespace
}  // namespace gelatin
