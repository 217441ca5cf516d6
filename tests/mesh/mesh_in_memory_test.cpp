#include "mesh/mesh_in_memory.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "gelatin/error.h"
#include "mesh/shapes.h"
#include "mesh/surface_repair.h"

namespace gelatin {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

Mesh make_tet() {
    return {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {}, {{0, 1, 2, 3}}, {}};
}

Mesh make_box_mesh() {
    const SurfaceMesh box = make_box({});
    return {box.positions, box.faces, {}, {}};
}

std::string problem_of(const Mesh& mesh) {
    const auto problem = find_problem(mesh);
    if (!problem) return "none";
    std::string text = problem->array;
    if (problem->index) text += "[" + std::to_string(*problem->index) + "]";
    return text + " = " + problem->value + ": " + problem->problem;
}

TEST(MeshInMemory, NamesWhatIsWrong) {
    EXPECT_EQ(problem_of(make_tet()), "none");
    EXPECT_EQ(problem_of(make_box_mesh()), "none");
    EXPECT_EQ(problem_of({}), " = : has neither triangles nor tets");
    Mesh mesh = make_tet();
    mesh.triangles = {{0, 1, 2}};
    EXPECT_EQ(problem_of(mesh), " = : must have triangles or tets, not both");
    mesh = make_tet();
    mesh.vertices[2].y = std::numeric_limits<double>::infinity();
    EXPECT_EQ(problem_of(mesh), "vertices[2] = [0, inf, 0]: must be finite");
    mesh = make_tet();
    mesh.tets.push_back({0, 1, 2, 4});
    EXPECT_EQ(problem_of(mesh), "tets[1] = 4: must name one of 4 vertices, from 0");
    mesh = make_box_mesh();
    mesh.triangles[3].z = 4000000000u;
    EXPECT_EQ(problem_of(mesh), "triangles[3] = 4000000000: must name one of 8 vertices, from 0");
    mesh = make_tet();
    mesh.attributes = {1, 2};
    EXPECT_EQ(problem_of(mesh), "attributes = : are 2 for 1 tet; allowed are none, or one for each tet");
}

TEST(MeshInMemory, TetsAreRepairedAsThoseOfFiles) {
    Mesh mesh = make_tet();
    mesh.vertices.emplace_back(9, 9, 9);       // unused
    mesh.tets = {{0, 2, 1, 3}, {0, 1, 2, 3}};  // inverted, and twice
    mesh.attributes = {7, 7};
    Notes notes;
    const TetMesh tets = tets_in_memory(mesh, "object 'a'", notes);
    EXPECT_EQ(tets.positions.size(), 4u);
    ASSERT_EQ(tets.tets.size(), 1u);
    EXPECT_EQ(tets.faces.size(), 4u);
    EXPECT_THAT(tets.attributes, ElementsAre(7));
    EXPECT_THAT(notes, ElementsAre("discarded nodes without tets: 1", "flipped inverted tets: 1",
                                   "discarded duplicate tets: 1"));
}

TEST(MeshInMemory, FlatTetsAreRefusedByName) {
    Mesh mesh = make_tet();
    mesh.vertices[3] = {1, 1, 0};
    Notes notes;
    try {
        tets_in_memory(mesh, "object 'a'", notes);
        FAIL() << "a flat tet was taken";
    } catch (const InvalidInput& error) {
        EXPECT_THAT(error.what(), HasSubstr("object 'a': tet 1: is flat"));
    }
}

TEST(MeshInMemory, SurfacesAreRepairedAsThoseOfFiles) {
    Mesh mesh = make_box_mesh();
    std::swap(mesh.triangles[0].x, mesh.triangles[0].y);
    Notes notes;
    const SurfaceMesh surface = surface_in_memory(mesh, "object 'a'", notes);
    EXPECT_NEAR(signed_volume(surface), 1.0, 1e-12);
    EXPECT_EQ(notes.size(), 1u);
    mesh.vertices.assign(mesh.vertices.size(), glm::dvec3(0.0));
    EXPECT_THROW(surface_in_memory(mesh, "object 'a'", notes), InvalidInput);
}

}  // namespace
}  // namespace gelatin
