#include "render/static_mesh.h"

#include <gtest/gtest.h>

#include "mesh/shapes.h"
#include "support/gl_fixture.h"

namespace gelatin::render {
namespace {

class StaticMeshTest : public test::GlTest {};

TEST_F(StaticMeshTest, SmoothSurfacesShareTheirVertices) {
    const StaticMesh mesh({make_sphere({0.5, 6})});
    EXPECT_EQ(mesh.view().vertex_count, 10u * 36 + 2);
    EXPECT_EQ(mesh.view().face_count, 20u * 36);
    EXPECT_EQ(mesh.view().object_count, 1u);
}

// A corner of a box has a vertex for each of its three sides, a node within an edge two, one within a side
// one.
TEST_F(StaticMeshTest, SharpEdgesSplitTheirVertices) {
    const StaticMesh corners({make_box({glm::dvec3(1.0), glm::ivec3(1)})});
    EXPECT_EQ(corners.view().vertex_count, 24u);
    EXPECT_EQ(corners.view().face_count, 12u);
    const StaticMesh finer({make_box({glm::dvec3(1.0), glm::ivec3(2)})});
    EXPECT_EQ(finer.view().vertex_count, 24u + 12u * 2 + 6u);
}

TEST_F(StaticMeshTest, SeveralSurfacesAreObjectsOfOneView) {
    const SurfaceMesh sphere = make_sphere({0.5, 6});
    const StaticMesh mesh({sphere, sphere, sphere});
    EXPECT_EQ(mesh.view().object_count, 3u);
    EXPECT_EQ(mesh.view().node_count, 3u * 362);
    EXPECT_EQ(mesh.view().face_count, 3u * 720);
}

TEST_F(StaticMeshTest, NoSurfacesAreAnEmptyView) {
    EXPECT_EQ(StaticMesh(std::vector<SurfaceMesh>()).view().face_count, 0u);
    EXPECT_EQ(StaticMesh().view().face_count, 0u);
}

}  // namespace
}  // namespace gelatin::render
