#include "mesh/lattice/fill_with_lattice.h"

#include <gmock/gmock.h>
#include <tbb/global_control.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "mesh/lattice/broken_surfaces.h"
#include "mesh/lattice/long_faces.h"
#include "mesh/lattice/sound_tets.h"
#include "mesh/surface_repair.h"

namespace gelatin {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

struct Filled {
    TetMesh mesh;
    Notes notes;
};

Filled fill(const SurfaceMesh& surface, const LatticeSize& size = {}) {
    Filled filled;
    filled.mesh = fill_with_lattice(surface, size, "thing", filled.notes);
    return filled;
}

std::string error_of(const SurfaceMesh& surface, const LatticeSize& size = {}) {
    return refusal([&] { fill(surface, size); });
}

LatticeSize with_nodes(int nodes) {
    return {.nodes = nodes, .cell_size = {}, .max_volume = {}};
}
LatticeSize with_cells(double size) {
    return {.nodes = {}, .cell_size = size, .max_volume = {}};
}
LatticeSize with_volume(double volume) {
    return {.nodes = {}, .cell_size = {}, .max_volume = volume};
}

constexpr double kLeastAngle = 8.0;  // degrees

TEST(FillWithLatticeTest, FillsASphereWithGoodTets) {
    const auto [mesh, notes] = fill(make_sphere({0.5, 20}));
    expect_sound(mesh);
    EXPECT_THAT(notes, IsEmpty());
    EXPECT_GT(least_dihedral_angle(mesh), kLeastAngle);
    EXPECT_NEAR(static_cast<double>(mesh.positions.size()), 5000.0, 1000.0);
    EXPECT_NEAR(total_volume(mesh), std::numbers::pi / 6.0, 0.02 * std::numbers::pi / 6.0);
}

// The boundary's nodes lie on the surface, so that the volume between it and the boundary is of second order.
TEST(FillWithLatticeHeavy, VolumeErrorIsOfSecondOrderInTheCellSize) {
    const SurfaceMesh sphere = make_sphere({0.5, 80});
    const double exact = signed_volume(sphere);
    const double coarse = exact - total_volume(fill(sphere, with_cells(0.1)).mesh);
    const double fine = exact - total_volume(fill(sphere, with_cells(0.05)).mesh);
    EXPECT_GT(fine, 0.0);
    EXPECT_NEAR(std::log2(coarse / fine), 2.0, 0.3);
}

TEST(FillWithLatticeTest, NodesOfTheBoundaryLieOnTheSurface) {
    const Filled filled = fill(cube({1.0, 2.0, 3.0}, 2.0), with_nodes(800));
    for (const glm::uvec3& face : filled.mesh.faces) {
        for (int k = 0; k < 3; ++k) {
            const glm::dvec3 d = glm::abs(filled.mesh.positions[face[k]] - glm::dvec3(2.0, 3.0, 4.0));
            EXPECT_NEAR(std::max({d.x, d.y, d.z}), 1.0, 1e-6);
        }
    }
}

TEST(FillWithLatticeHeavy, HasAboutTheWantedNodes) {
    SurfaceMesh two = make_sphere({0.5, 8});
    append(two, cube({0.2, 0.2, 0.2}, 1.0));
    for (const SurfaceMesh& surface : {make_sphere({0.5, 10}), make_box({{1.0, 0.2, 0.6}, {1, 1, 1}}), two}) {
        for (const int wanted : {100, 1000, 20000}) {
            const Filled filled = fill(surface, with_nodes(wanted));
            expect_sound(filled.mesh);
            EXPECT_NEAR(static_cast<double>(filled.mesh.positions.size()), wanted, 0.2 * wanted);
            EXPECT_GT(least_dihedral_angle(filled.mesh), kLeastAngle);
        }
    }
}

TEST(FillWithLatticeTest, NoTetIsLargerThanTheVolumeAllowed) {
    constexpr double kAllowed = 2e-4;
    const Filled filled = fill(make_sphere({0.5, 10}), with_volume(kAllowed));
    expect_sound(filled.mesh);
    double largest = 0.0;
    for (const glm::uvec4& tet : filled.mesh.tets) largest = std::max(largest, tet_volume(filled.mesh, tet));
    EXPECT_LE(largest, kAllowed);
    EXPECT_GT(largest, 0.5 * kAllowed);
}

TEST(FillWithLatticeHeavy, IsCoarserInside) {
    const TetMesh mesh = fill(make_sphere({0.5, 20}), with_cells(0.03)).mesh;
    double inner = 0.0, outer = 0.0;
    for (const glm::uvec4& tet : mesh.tets) {
        const glm::dvec3 center = 0.25 * (mesh.positions[tet[0]] + mesh.positions[tet[1]] +
                                          mesh.positions[tet[2]] + mesh.positions[tet[3]]);
        double& largest = glm::length(center) < 0.2 ? inner : outer;
        if (glm::length(center) < 0.2 || glm::length(center) > 0.47)
            largest = std::max(largest, tet_volume(mesh, tet));
    }
    EXPECT_GT(inner, 15.0 * outer);  // 4^3 in the lattice; points that move add some outside
}

TEST(FillWithLatticeHeavy, GivesTheSameBitsForAnyNumberOfThreads) {
    SurfaceMesh surface = make_sphere({0.5, 12});
    surface.faces.resize(surface.faces.size() - 300);
    append(surface, make_capsule({0.03, 1.5, 3}));
    std::vector<TetMesh> meshes;
    for (const std::size_t threads : {1, 2, 5}) {
        const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
        meshes.push_back(fill(surface).mesh);
    }
    for (const TetMesh& mesh : meshes) {
        EXPECT_EQ(mesh.positions, meshes[0].positions);
        EXPECT_EQ(mesh.tets, meshes[0].tets);
        EXPECT_EQ(mesh.faces, meshes[0].faces);
    }
}

TEST(FillWithLatticeTest, DoesNotDependOnPlaceAndUnits) {
    SurfaceMesh small = make_sphere({0.5, 8});
    const TetMesh mesh = fill(small, with_nodes(500)).mesh;
    for (glm::dvec3& p : small.positions) p = 1e-6 * p + glm::dvec3(3e-5);
    const TetMesh other = fill(small, with_nodes(500)).mesh;
    EXPECT_EQ(other.tets.size(), mesh.tets.size());
    EXPECT_NEAR(total_volume(other) / total_volume(mesh), 1e-18, 1e-21);
}

TEST(FillWithLatticeTest, ClosesHoles) {
    SurfaceMesh open = cube({0.0, 0.0, 0.0}, 1.0);
    open.faces.pop_back();  // half of a side
    const Filled filled = fill(open, with_nodes(2000));
    expect_sound(filled.mesh);
    EXPECT_NEAR(total_volume(filled.mesh), 1.0, 0.1);
    EXPECT_GT(least_dihedral_angle(filled.mesh), kLeastAngle);
}

TEST(FillWithLatticeTest, FillsTheUnionOfSurfacesThatCross) {
    SurfaceMesh crossing = cube({0.0, 0.0, 0.0}, 1.0);
    append(crossing, cube({0.5, 0.0, 0.0}, 1.0));
    const Filled filled = fill(crossing, with_nodes(3000));
    expect_sound(filled.mesh);
    EXPECT_NEAR(total_volume(filled.mesh), 1.5, 0.03);
}

TEST(FillWithLatticeTest, LeavesCavitiesEmpty) {
    SurfaceMesh shell = cube({0.0, 0.0, 0.0}, 1.0);
    SurfaceMesh cavity = cube({0.25, 0.25, 0.25}, 0.5);
    for (glm::uvec3& face : cavity.faces) std::swap(face[1], face[2]);
    append(shell, cavity);
    const Filled filled = fill(shell, with_nodes(3000));
    expect_sound(filled.mesh);
    EXPECT_NEAR(total_volume(filled.mesh), 0.875, 0.03);
}

// A body with a thin handle: an eighth as thick as the cells that the rest would have.
TEST(FillWithLatticeTest, ResolvesThinPartsByFinerCells) {
    SurfaceMesh surface = cube({0.0, 0.0, 0.0}, 1.0);
    append(surface, make_box({{3.0, 0.04, 0.04}, {1, 1, 1}}));
    const Filled filled = fill(surface, with_cells(0.1));
    expect_sound(filled.mesh);
    EXPECT_THAT(filled.notes, IsEmpty());
    double reach = 0.0;
    for (const glm::dvec3& p : filled.mesh.positions) reach = std::max(reach, std::abs(p.x));
    EXPECT_GT(reach, 1.48);
    EXPECT_GT(least_dihedral_angle(filled.mesh), kLeastAngle);
}

TEST(FillWithLatticeTest, ReportsThinPartsThatAreLost) {
    SurfaceMesh surface = cube({0.0, 0.0, 0.0}, 1.0);
    append(surface, make_box({{3.0, 0.004, 1.0}, {1, 1, 1}}));
    surface.faces.emplace_back(0, 8, 8);  // without area: both are one piece
    const Filled filled = fill(surface, with_cells(0.1));
    expect_sound(filled.mesh);
    ASSERT_FALSE(filled.notes.empty());
    EXPECT_THAT(filled.notes.back(), HasSubstr("parts that are thinner than the cells are missing"));
    EXPECT_THAT(filled.notes.back(), HasSubstr("cells of about 0.013 m instead of 0.1 keep most of them"));
}

TEST(FillWithLatticeTest, ReportsPiecesThatAreLost) {
    SurfaceMesh surface = cube({0.0, 0.0, 0.0}, 1.0);
    append(surface, cube({2.0, 0.0, 0.0}, 0.002));
    const Filled filled = fill(surface, with_cells(0.1));
    ASSERT_FALSE(filled.notes.empty());
    EXPECT_THAT(filled.notes.back(),
                HasSubstr("pieces of the surface that are smaller than the cells are missing: 1"));
}

TEST(FillWithLatticeTest, RefusesSurfacesThatEncloseNothing) {
    SurfaceMesh sheet;
    sheet.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
    sheet.faces = {{0, 1, 2}, {0, 2, 3}};
    EXPECT_THAT(error_of(sheet),
                HasSubstr("thing: the surface encloses no volume that could be filled with tets, as a "
                          "flat sheet does not; close it, or give it a thickness"));
    EXPECT_THAT(error_of(sheet, with_cells(0.1)), HasSubstr("encloses no volume"));
    EXPECT_THAT(error_of(sheet, with_volume(1e-4)), HasSubstr("encloses no volume"));
    EXPECT_THAT(error_of({}), HasSubstr("no faces"));
    sheet.positions.assign(4, glm::dvec3(1.0));
    EXPECT_THAT(error_of(sheet), HasSubstr("encloses no volume"));
}

TEST(FillWithLatticeTest, RefusesBodiesThatAreTooThinWithASizeThatFillsThem) {
    const SurfaceMesh plate = make_box({{1.0, 0.03, 1.0}, {1, 1, 1}});
    const std::string error = error_of(plate, with_cells(1.0));
    EXPECT_THAT(error, HasSubstr("too thin for cells of 1 m; mesher.cell_size = "));
    const std::string advice = "mesher.cell_size = ";
    const Filled filled =
        fill(plate, with_cells(std::stod(error.substr(error.find(advice) + advice.size()))));
    expect_sound(filled.mesh);
    EXPECT_NEAR(total_volume(filled.mesh), 0.03, 0.003);
    EXPECT_THAT(error,
                HasSubstr(" fills it, with " + std::to_string(filled.mesh.positions.size()) + " nodes"));
}

TEST(FillWithLatticeHeavy, AdvisesNoSizeThatWouldBeRefused) {
    const std::string error = error_of(make_box({{94.0, 64.0, 0.25}, {1, 1, 1}}));
    EXPECT_THAT(error, HasSubstr("most of it is too thin for 5000 nodes: it needs cells of "));
    EXPECT_THAT(error, HasSubstr("make it thicker"));
    EXPECT_THAT(error, testing::Not(HasSubstr("mesher.cell_size")));
}

TEST(FillWithLatticeTest, FillsFansOfLongThinFaces) {
    const Filled filled = fill(make_fan_disc(1000), with_nodes(1000));
    expect_sound(filled.mesh);
    EXPECT_THAT(filled.notes, IsEmpty());
    EXPECT_NEAR(total_volume(filled.mesh), 0.05 * std::numbers::pi, 0.05 * 0.05 * std::numbers::pi);
}

TEST(FillWithLatticeTest, RefusesNumbersThatAreNotFinite) {
    SurfaceMesh surface = cube({0.0, 0.0, 0.0}, 1.0);
    surface.positions[2].y = std::numeric_limits<double>::quiet_NaN();
    EXPECT_THAT(error_of(surface), HasSubstr("thing: vertex 3 has a coordinate that is not a finite number"));
    surface.positions[2].y = 1e308;
    surface.positions[0].y = -1e308;
    EXPECT_THAT(error_of(surface), HasSubstr("too large"));
}

TEST(FillWithLatticeTest, RefusesTooManyCells) {
    EXPECT_THAT(error_of(make_sphere({0.5, 4}), with_cells(1e-4)),
                HasSubstr("there would be more than 1500000 of them"));
    EXPECT_THAT(error_of(make_sphere({0.5, 4}), with_volume(1e-30)),
                HasSubstr("there would be more than 1500000 of them"));
}

TEST(BrokenSurfacesLong, ThousandsOfPiecesAreFilled) {
    SurfaceMesh crumbs;
    for (int k = 0; k < 3000; ++k)
        append(crumbs, cube({0.05 * (k % 20), 0.05 * (k / 20 % 15), 0.05 * (k / 300)}, 0.04));
    expect_sound(fill(crumbs, with_cells(0.04)).mesh);
}

// A body, or an error that says why not.
void expect_bodies_or_errors(unsigned first, unsigned end) {
    unsigned bodies = 0;
    for (unsigned seed = first; seed < end; ++seed) {
        SCOPED_TRACE(seed);
        try {
            expect_sound(fill(BrokenSurfaces(seed).make(), with_nodes(seed % 3 == 0 ? 1000 : 100)).mesh);
            ++bodies;
        } catch (const InvalidInput& error) {
            EXPECT_THAT(error.what(), HasSubstr("thing: "));
        }
    }
    EXPECT_GT(bodies, (end - first) / 3);
}

TEST(BrokenSurfacesTest, GiveABodyOrAnError) {
    expect_bodies_or_errors(5, 10);
}

TEST(BrokenSurfacesLong, GiveABodyOrAnError) {
    expect_bodies_or_errors(10, 250);
}

}  // namespace
}  // namespace gelatin
