#include "model/build/object_mesh.h"

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

}  // namespace
}  // namespace gelatin
