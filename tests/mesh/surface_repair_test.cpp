#include "mesh/surface_repair.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <utility>

#include "mesh_samples.h"
#include "support/draw_vector.h"

namespace gelatin {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

void turn(glm::uvec3& face) {
    std::swap(face[1], face[2]);
}

// The same faces, each with three vertices of its own, as STL has them.
SurfaceMesh unshare(const SurfaceMesh& mesh) {
    SurfaceMesh soup;
    for (const glm::uvec3& face : mesh.faces) {
        const auto first = static_cast<std::uint32_t>(soup.positions.size());
        for (int corner = 0; corner < 3; ++corner) soup.positions.push_back(mesh.positions[face[corner]]);
        soup.faces.emplace_back(first, first + 1, first + 2);
    }
    return soup;
}

Notes repair(SurfaceMesh& mesh) {
    Notes notes;
    repair_surface(mesh, notes);
    return notes;
}

TEST(RepairSurface, LeavesAGoodMeshAlone) {
    SurfaceMesh mesh = cube({0, 0, 0}, 1.0);
    const SurfaceMesh before = mesh;
    EXPECT_THAT(repair(mesh), IsEmpty());
    EXPECT_EQ(mesh.positions, before.positions);
    EXPECT_EQ(mesh.faces, before.faces);
}

TEST(RepairSurface, TakesAnEmptyMesh) {
    SurfaceMesh mesh;
    EXPECT_THAT(repair(mesh), IsEmpty());
}

TEST(RepairSurface, MergesVerticesThatCoincide) {
    SurfaceMesh mesh = unshare(cube({3, -2, 1}, 0.5));
    EXPECT_THAT(repair(mesh), ElementsAre("merged vertices that coincide: 28"));
    EXPECT_EQ(mesh.positions.size(), 8u);
    EXPECT_TRUE(measure_openness(mesh).is_closed());
    EXPECT_DOUBLE_EQ(signed_volume(mesh), 0.125);
}

// The tolerance is 1e-9 of the diagonal, and the search goes by cells of 8 tolerances: boxes of any shape put
// some pairs across the cells' boundaries.
TEST(RepairSurface, MergesWithinTheToleranceOnly) {
    std::mt19937 random(5);
    std::uniform_real_distribution<double> shift(-1.0, 1.0);
    for (int trial = 0; trial < 50; ++trial) {
        SurfaceMesh near = unshare(cube({0.1, 0.2, 0.3}, 1.0));
        const glm::dvec3 stretch = 2.0 + test::draw_vector<glm::dvec3>(shift, random);
        for (glm::dvec3& p : near.positions) {
            p = stretch * p + 4e-10 * test::draw_vector<glm::dvec3>(shift, random);
        }
        repair(near);
        EXPECT_EQ(near.positions.size(), 8u);
    }
    SurfaceMesh far = cube({0, 0, 0}, 1.0);
    far.positions.push_back(far.positions[0] + glm::dvec3(3e-9, 0, 0));
    far.faces[0][0] = 8;
    repair(far);
    EXPECT_EQ(far.positions.size(), 9u);
}

TEST(RepairSurface, MergesWhateverTheScale) {
    for (const double size : {1e-7, 1e7}) {
        SurfaceMesh mesh = unshare(cube({0, 0, 0}, size));
        repair(mesh);
        EXPECT_EQ(mesh.positions.size(), 8u) << size;
    }
}

TEST(RepairSurface, DropsFacesWithoutArea) {
    SurfaceMesh mesh = cube({0, 0, 0}, 1.0);
    mesh.faces.emplace_back(2, 2, 5);
    mesh.positions.emplace_back(0.5, 0, 0);  // on the edge from vertex 0 to vertex 1
    mesh.faces.emplace_back(0, 8, 1);
    EXPECT_THAT(repair(mesh),
                ElementsAre("discarded faces without area: 2", "discarded vertices without faces: 1"));
    EXPECT_EQ(mesh.faces.size(), 12u);
    EXPECT_EQ(mesh.positions.size(), 8u);
}

TEST(RepairSurface, KeepsThinFaces) {
    SurfaceMesh mesh;
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0.5, 1e-6, 0}};
    mesh.faces = {{0, 1, 2}};
    repair(mesh);
    EXPECT_EQ(mesh.faces.size(), 1u);
}

TEST(RepairSurface, DropsRepeatedFaces) {
    SurfaceMesh mesh = cube({0, 0, 0}, 1.0);
    glm::uvec3 again = mesh.faces[3];
    mesh.faces.emplace_back(again[1], again[2], again[0]);
    turn(again);
    mesh.faces.push_back(again);
    EXPECT_THAT(repair(mesh), ElementsAre("discarded duplicate faces: 2"));
    EXPECT_EQ(mesh.faces, cube({0, 0, 0}, 1.0).faces);
}

TEST(RepairSurface, DropsVerticesWithoutFaces) {
    SurfaceMesh mesh = cube({0, 0, 0}, 1.0);
    mesh.positions.insert(mesh.positions.begin(), {7, 7, 7});
    for (glm::uvec3& face : mesh.faces) face += 1u;
    EXPECT_THAT(repair(mesh), ElementsAre("discarded vertices without faces: 1"));
    EXPECT_EQ(mesh.positions, cube({0, 0, 0}, 1.0).positions);
    EXPECT_EQ(mesh.faces, cube({0, 0, 0}, 1.0).faces);
}

TEST(RepairSurface, MakesTheWindingConsistent) {
    const SurfaceMesh good = cube({0, 0, 0}, 1.0);
    for (unsigned pattern = 1; pattern < 4096; pattern += 37) {
        SurfaceMesh mesh = good;
        int turned = 0;
        for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
            if ((pattern >> f & 1u) == 0) continue;
            turn(mesh.faces[f]);
            ++turned;
        }
        EXPECT_THAT(repair(mesh),
                    ElementsAre("flipped faces with the wrong orientation: " + std::to_string(turned)));
        EXPECT_EQ(mesh.faces, good.faces);
    }
}

TEST(RepairSurface, TurnsEachPartOutward) {
    SurfaceMesh mesh = cube({0, 0, 0}, 1.0);
    append(mesh, cube({5, 0, 0}, 2.0));
    for (std::size_t f = 12; f < 24; ++f) turn(mesh.faces[f]);
    EXPECT_THAT(repair(mesh), ElementsAre("flipped faces with the wrong orientation: 12"));
    EXPECT_DOUBLE_EQ(signed_volume(mesh), 9.0);
}

// An open part far from the origin: its volume must not depend on where it lies.
TEST(RepairSurface, TurnsAnOpenPartOutward) {
    SurfaceMesh mesh = cube({100, 0, 0}, 1.0);  // without its side at x = 101
    mesh.faces.resize(10);
    const std::vector<glm::uvec3> good = mesh.faces;
    for (glm::uvec3& face : mesh.faces) turn(face);
    repair(mesh);
    EXPECT_EQ(mesh.faces, good);
}

const char* const kCavity =
    "cavities, as these closed pieces and the body around have opposite orientations: ";
const char* const kInCavity = "closed pieces inside cavities, which are bodies of their own: ";
const char* const kOverlapping =
    "discarded closed pieces inside a body of the same orientation, which are bodies that overlap it and no "
    "cavities (reverse their faces to make them cavities): ";

/// Cubes, each inside the one before it; true: its faces look inwards.
SurfaceMesh nested_cubes(const std::vector<bool>& inward) {
    SurfaceMesh mesh;
    for (std::size_t k = 0; k < inward.size(); ++k) {
        const auto inset = static_cast<double>(k);
        SurfaceMesh piece = cube(glm::dvec3(inset), 8.0 - 2.0 * inset);
        if (inward[k]) std::for_each(piece.faces.begin(), piece.faces.end(), turn);
        append(mesh, piece);
    }
    return mesh;
}

TEST(RepairSurface, ClosedPiecesInsideABodyAreCavitiesByTheirOrientation) {
    SurfaceMesh mesh = nested_cubes({false, true});
    const SurfaceMesh before = mesh;
    EXPECT_THAT(repair(mesh), ElementsAre(kCavity + std::string("1")));
    EXPECT_EQ(mesh.faces, before.faces);
    EXPECT_DOUBLE_EQ(signed_volume(mesh), 512.0 - 216.0);

    mesh = nested_cubes({true, false});  // the file as a whole is inside out
    EXPECT_THAT(repair(mesh),
                ElementsAre("flipped faces with the wrong orientation: 24", kCavity + std::string("1")));
    EXPECT_DOUBLE_EQ(signed_volume(mesh), 512.0 - 216.0);

    for (const bool inward : {false, true}) {
        mesh = nested_cubes({inward, inward});
        EXPECT_THAT(repair(mesh), testing::Contains(kOverlapping + std::string("1")));
        EXPECT_EQ(mesh.positions, cube({0, 0, 0}, 8.0).positions);
        EXPECT_EQ(mesh.faces, cube({0, 0, 0}, 8.0).faces);
    }
}

TEST(RepairSurface, ClosedPiecesInsideCavitiesAreBodies) {
    for (const bool inward : {false, true}) {  // there is nothing else that it could be
        SurfaceMesh mesh = nested_cubes({false, true, inward});
        const Notes notes = repair(mesh);
        EXPECT_THAT(notes, testing::Contains(kCavity + std::string("1")));
        EXPECT_THAT(notes, testing::Contains(kInCavity + std::string("1")));
        EXPECT_DOUBLE_EQ(signed_volume(mesh), 512.0 - 216.0 + 64.0);
    }
    SurfaceMesh mesh = nested_cubes({false, true, false, true});
    append(mesh, cube({10, 1, 1}, 1.0));  // beside them
    const Notes notes = repair(mesh);
    EXPECT_THAT(notes, ElementsAre(kCavity + std::string("2"), kInCavity + std::string("1")));
    EXPECT_DOUBLE_EQ(signed_volume(mesh), 512.0 - 216.0 + 64.0 - 8.0 + 1.0);
}

// A hollow body inside a body, and a cavity of both.
TEST(RepairSurface, SpaceIsEmptyWhereItIsInACavityOfEachBodyAroundIt) {
    SurfaceMesh mesh = nested_cubes({false, false, true});
    EXPECT_THAT(repair(mesh), ElementsAre(kOverlapping + std::string("2")));
    EXPECT_EQ(mesh.faces.size(), 12u);
    mesh = nested_cubes({false, false, true, true});
    EXPECT_THAT(repair(mesh), ElementsAre(kCavity + std::string("1"), kOverlapping + std::string("2")));
    EXPECT_DOUBLE_EQ(signed_volume(mesh), 512.0 - 8.0);
}

// What most faces of a piece have counts, if they do not agree.
TEST(RepairSurface, TheOrientationOfAPieceIsThatOfMostOfItsFaces) {
    SurfaceMesh mesh = nested_cubes({false, true});
    for (const std::size_t face : {12, 15, 16, 20, 23}) turn(mesh.faces[face]);
    EXPECT_THAT(repair(mesh),
                ElementsAre("flipped faces with the wrong orientation: 5", kCavity + std::string("1")));
    EXPECT_DOUBLE_EQ(signed_volume(mesh), 512.0 - 216.0);
}

TEST(RepairSurface, DiscardedPiecesTakeTheirLookWithThem) {
    SurfaceMesh mesh = nested_cubes({false, false, false});
    for (int f = 0; f < 36; ++f) {
        mesh.look.face_materials.push_back(static_cast<std::uint32_t>(f));
        mesh.look.corner_uvs.push_back({});
    }
    EXPECT_THAT(repair(mesh), ElementsAre(kOverlapping + std::string("2")));
    EXPECT_EQ(mesh.look.face_materials.size(), 12u);
    EXPECT_EQ(mesh.look.corner_uvs.size(), 12u);
}

// The inner piece shares a vertex with the outer one.
TEST(RepairSurface, FindsCavitiesThatTouchTheBody) {
    for (std::uint32_t v = 0; v < 8; ++v) {
        SurfaceMesh mesh = cube({0, 0, 0}, 4.0);
        SurfaceMesh piece = cube({1, 1, 1}, 2.0);
        std::for_each(piece.faces.begin(), piece.faces.end(), turn);
        piece.positions[v] = mesh.positions[v];
        append(mesh, piece);
        EXPECT_THAT(repair(mesh), ElementsAre("merged vertices that coincide: 1", kCavity + std::string("1")))
            << v;
    }
}

// Corners of the cube lie level with corners and edges of the octahedron around it, where rays go wrong.
TEST(RepairSurface, FindsCavitiesInAnyPosition) {
    for (int place = 0; place < 27; ++place) {
        SurfaceMesh mesh;
        mesh.positions = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
        mesh.faces = {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}};
        append(mesh, cube(glm::dvec3(place % 3 - 2, place / 3 % 3 - 2, place / 9 - 2) / 8.0, 0.25));
        for (std::size_t f = 8; f < mesh.faces.size(); ++f) turn(mesh.faces[f]);
        repair(mesh);
        EXPECT_NEAR(signed_volume(mesh), 4.0 / 3.0 - 1.0 / 64.0, 1e-12) << place;
    }
}

TEST(RepairSurface, TakesPartsThatOnlyOverlapAsSolid) {
    SurfaceMesh mesh = cube({0, 0, 0}, 2.0);
    append(mesh, cube({1, 0.5, 0.5}, 1.5));  // some of its corners are inside
    EXPECT_THAT(repair(mesh), IsEmpty());
}

TEST(RepairSurface, SaysThatASurfaceIsOneSided) {
    SurfaceMesh strip;  // Moebius, five quads
    for (std::uint32_t k = 0; k < 5; ++k) {
        const double turn_angle = 2.0 * 3.14159265358979 * k / 5.0;
        const glm::dvec3 around(std::cos(turn_angle), 0.0, std::sin(turn_angle));
        const glm::dvec3 across =
            0.3 * (std::cos(turn_angle / 2) * around + std::sin(turn_angle / 2) * glm::dvec3(0, 1, 0));
        strip.positions.push_back(around - across);
        strip.positions.push_back(around + across);
    }
    for (std::uint32_t k = 0; k < 5; ++k) {
        const std::uint32_t a = 2 * k, b = a + 1;
        const std::uint32_t c = k < 4 ? a + 2 : 1, d = k < 4 ? a + 3 : 0;
        strip.faces.emplace_back(a, b, c);
        strip.faces.emplace_back(b, d, c);
    }
    EXPECT_THAT(repair(strip), testing::Contains(HasSubstr("one-sided")));
}

TEST(MeasureOpenness, CountsEdges) {
    SurfaceMesh mesh = cube({0, 0, 0}, 1.0);
    EXPECT_TRUE(measure_openness(mesh).is_closed());
    mesh.faces.pop_back();
    EXPECT_EQ(measure_openness(mesh).boundary_edges, 3u);
    EXPECT_EQ(measure_openness(mesh).non_manifold_edges, 0u);
    mesh = cube({0, 0, 0}, 1.0);
    mesh.positions.emplace_back(9, 9, 9);
    mesh.faces.emplace_back(0, 1, 8);
    EXPECT_EQ(measure_openness(mesh).boundary_edges, 2u);
    EXPECT_EQ(measure_openness(mesh).non_manifold_edges, 1u);
    EXPECT_FALSE(measure_openness(mesh).is_closed());
}

TEST(SignedVolume, HasTheSignOfTheWinding) {
    SurfaceMesh mesh = cube({10, 20, 30}, 2.0);
    EXPECT_NEAR(signed_volume(mesh), 8.0, 1e-10);
    for (glm::uvec3& face : mesh.faces) turn(face);
    EXPECT_NEAR(signed_volume(mesh), -8.0, 1e-10);
}

}  // namespace
}  // namespace gelatin
