#include "mesh/fill_surface.h"

#include <gmock/gmock.h>

#include <cstdlib>
#include <filesystem>
#include <string>

#include "core/file.h"
#include "gelatin/error.h"
#include "mesh/shapes.h"
#include "mesh/tetrahedralise.h"
#include "mesh/topology.h"
#include "mesh_samples.h"

namespace gelatin {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::StartsWith;

MesherSettings by(MesherKind kind) {
    MesherSettings settings;
    settings.kind = kind;
    settings.nodes = 300;
    return settings;
}

SurfaceMesh make_cube() {
    return make_box({});
}

SurfaceMesh open_cube() {
    SurfaceMesh open = make_cube();
    open.faces.pop_back();
    return open;
}

TEST(FillSurface, ByTetGenWhereThatCan) {
    Notes notes;
    const TetMesh mesh = fill_surface(make_cube(), {}, "cube", notes);
    EXPECT_TRUE(notes.empty());
    EXPECT_EQ(mesh.tets, tetrahedralise(make_cube(), {}, "cube").tets);
}

TEST(FillSurface, ByTheLatticeWhereTetGenCannot) {
    Notes notes;
    const TetMesh mesh = fill_surface(open_cube(), by(MesherKind::automatic), "cube", notes);
    ASSERT_FALSE(notes.empty());
    EXPECT_EQ(notes.front(),
              "filled by the lattice mesher, because the surface is not closed: 3 edges have one face");
    Notes others;
    EXPECT_EQ(mesh.tets, fill_surface(open_cube(), by(MesherKind::lattice), "cube", others).tets);
    EXPECT_THROW(fill_surface(open_cube(), by(MesherKind::tetgen), "cube", notes), InvalidInput);
}

// Nor is there the program that TetGen's output goes through.
TEST(FillSurface, ByTheLatticeWithoutTetGen) {
    const TemporaryFolder nothing;
    const char* path = std::getenv("PATH");
    const std::string old_path = path == nullptr ? "" : path;
    ::setenv("PATH", nothing.path().c_str(), 1);
    Notes notes;
    SurfaceMesh cube = make_cube();
    for (glm::dvec3& position : cube.positions) position *= 1.25;  // not in the cache
    const TetMesh mesh = fill_surface(cube, by(MesherKind::automatic), "cube", notes);
    EXPECT_THROW(fill_surface(cube, by(MesherKind::tetgen), "cube", notes), SystemError);
    ::setenv("PATH", old_path.c_str(), 1);
    EXPECT_FALSE(mesh.tets.empty());
    ASSERT_FALSE(notes.empty());
    EXPECT_THAT(notes.front(), StartsWith("filled by the lattice mesher, because of "));
}

SurfaceMesh cube_with_cavity(double size) {
    SurfaceMesh shell = cube({0, 0, 0}, 1.0), cavity = cube(glm::dvec3(0.5 - 0.5 * size), size);
    for (glm::uvec3& face : cavity.faces) std::swap(face[1], face[2]);
    append(shell, cavity);
    return shell;
}

TEST(FillSurface, BothMeshersLeaveCavitiesEmpty) {
    const SurfaceMesh shell = cube_with_cavity(0.5);
    Notes notes;
    EXPECT_NEAR(total_volume(fill_surface(shell, by(MesherKind::tetgen), "shell", notes)), 0.875, 1e-9);
    MesherSettings fine = by(MesherKind::lattice);
    fine.nodes = 3000;
    EXPECT_NEAR(total_volume(fill_surface(shell, fine, "shell", notes)), 0.875, 0.02);
    for (const Note& note : notes) EXPECT_FALSE(note.is_warning) << note.text;
}

TEST(FillSurface, WarnsOfCavitiesThatTheLatticeFills) {
    Notes notes;
    fill_surface(cube_with_cavity(0.03), by(MesherKind::lattice), "shell", notes);
    EXPECT_THAT(notes,
                ElementsAre(warning("cavities that are too small for the lattice's cells are filled: 1; a "
                                    "smaller mesher.cell_size, or more mesher.nodes, would keep them")));
}

void expect_about(const TetMesh& mesh, int nodes) {
    EXPECT_NEAR(static_cast<double>(mesh.positions.size()), nodes, 0.2 * nodes);
}

// TetGen keeps the 8 and the 252 vertices, and adds what is missing.
TEST(FillSurface, HasAboutTheWantedNodes) {
    for (const SurfaceMesh& surface :
         {make_cube(), make_sphere({0.5, 5}), make_box({{1.0, 0.2, 0.1}, {9, 2, 1}})}) {
        for (const int nodes : {700, 3000}) {
            MesherSettings settings = by(MesherKind::tetgen);
            settings.nodes = nodes;
            Notes notes;
            const TetMesh mesh = fill_surface(surface, settings, "thing", notes);
            expect_about(mesh, nodes);
            EXPECT_THAT(notes, IsEmpty());
            settings.kind = MesherKind::automatic;
            EXPECT_EQ(fill_surface(surface, settings, "thing", notes).tets, mesh.tets);
            EXPECT_THAT(notes, ElementsAre("filled by TetGen with " + std::to_string(mesh.positions.size()) +
                                           " nodes: the surface is closed and no finer than wanted"));
        }
    }
}

TEST(FillSurface, ByTheLatticeWhereTheSurfaceIsFinerThanWanted) {
    const SurfaceMesh sphere = make_sphere({0.5, 10});
    Notes notes;
    expect_about(fill_surface(sphere, by(MesherKind::automatic), "ball", notes), 300);
    EXPECT_THAT(notes,
                ElementsAre("filled by the lattice mesher, because the surface alone has 1002 vertices, "
                            "and 300 nodes are wanted"));
    notes.clear();
    const TetMesh mesh = fill_surface(sphere, by(MesherKind::tetgen), "ball", notes);
    EXPECT_EQ(mesh.tets, tetrahedralise(sphere, {}, "ball").tets);
    EXPECT_THAT(notes, ElementsAre("TetGen makes " + std::to_string(mesh.positions.size()) +
                                   " nodes of this surface, which has 1002 vertices; 300 were wanted"));
}

// The vertices are not too many, but with what the inside needs.
TEST(FillSurface, ByTheLatticeWhereTheInsideNeedsTooManyNodes) {
    MesherSettings settings;
    settings.nodes = 850;
    settings.quality = 1.2;
    Notes notes;
    expect_about(fill_surface(make_sphere({0.5, 10}), settings, "ball", notes), 850);
    EXPECT_THAT(notes, ElementsAre(StartsWith("filled by the lattice mesher, because TetGen makes ")));
}

// TetGen would need minutes for a plate that is finer than this one.
TEST(FillSurfaceHeavy, ByTheLatticeWhereTheSurfaceIsFarTooThinForTetGen) {
    Notes notes;
    EXPECT_THROW(
        fill_surface(make_box({{94.0, 64.0, 0.25}, {1, 1, 1}}), by(MesherKind::automatic), "plate", notes),
        InvalidInput);
    EXPECT_THAT(notes, ElementsAre(HasSubstr("TetGen would make about 98")));
}

TEST(FillSurface, ByTheLatticeForItsCellSize) {
    MesherSettings settings;
    settings.cell_size = 0.25;
    Notes notes, others;
    const TetMesh mesh = fill_surface(make_cube(), settings, "cube", notes);
    EXPECT_THAT(notes, ElementsAre(HasSubstr("mesher.cell_size")));
    settings.kind = MesherKind::lattice;
    EXPECT_EQ(fill_surface(make_cube(), settings, "cube", others).tets, mesh.tets);
}

// A damaged entry would be made anew: what is found must be what the entry says.
TEST(FillSurface, KeepsLatticesInTheCache) {
    const TemporaryFolder folder;
    const char* cache = std::getenv("GELATIN_CACHE_DIR");
    const std::string old_cache = cache == nullptr ? "" : cache;
    ::setenv("GELATIN_CACHE_DIR", folder.path().c_str(), 1);
    const auto entries = [&] {
        return std::distance(std::filesystem::directory_iterator(folder.path()), {});
    };
    MesherSettings settings = by(MesherKind::lattice);
    settings.nodes = 300;
    Notes first, second, third;
    const SurfaceMesh plate = make_box({{2.4, 0.3, 0.004}, {1, 1, 1}});
    SurfaceMesh surface = make_sphere({0.5, 6});
    for (const glm::uvec3& face : plate.faces)
        surface.faces.push_back(face + static_cast<std::uint32_t>(surface.positions.size()));
    surface.positions.insert(surface.positions.end(), plate.positions.begin(), plate.positions.end());
    const TetMesh made = fill_surface(surface, settings, "thing", first);
    EXPECT_EQ(entries(), 1);
    const std::filesystem::path entry = std::filesystem::directory_iterator(folder.path())->path();
    const auto written = std::filesystem::last_write_time(entry);
    const TetMesh found = fill_surface(surface, settings, "another name", second);
    EXPECT_EQ(std::filesystem::last_write_time(entry), written) << "made a second time";
    EXPECT_EQ(found.positions, made.positions);
    EXPECT_EQ(found.tets, made.tets);
    EXPECT_FALSE(first.empty()) << "the plate is too thin";
    EXPECT_EQ(first, second);

    settings.nodes = 400;
    fill_surface(surface, settings, "thing", third);
    EXPECT_EQ(entries(), 2);
    settings.nodes.reset();
    settings.cell_size = 0.3;
    fill_surface(surface, settings, "thing", third);
    EXPECT_EQ(entries(), 3);
    surface.positions.front().x += 1e-9;
    fill_surface(surface, settings, "thing", third);
    EXPECT_EQ(entries(), 4);
    ::setenv("GELATIN_CACHE_DIR", old_cache.c_str(), 1);
}

TEST(FillSurface, SizesOfFiles) {
    EXPECT_EQ(sized({}).nodes, 5000);
    MesherSettings settings;
    settings.max_volume = 1.0;
    EXPECT_EQ(sized(settings), settings);
    EXPECT_EQ(sized(by(MesherKind::lattice)).nodes, 300);
}

TEST(FillSurface, RefusesWhatNeitherCanFill) {
    Notes notes;
    const SurfaceMesh sheet{{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {{0, 1, 2}, {0, 2, 3}}};
    EXPECT_THROW(fill_surface(sheet, {}, "sheet", notes), InvalidInput);
    EXPECT_THROW(fill_surface({}, {}, "nothing", notes), InvalidInput);
    MesherSettings fine;
    fine.max_volume = 1e-12;
    notes.clear();
    EXPECT_THROW(fill_surface(make_cube(), fine, "cube", notes), InvalidInput);
    EXPECT_TRUE(notes.empty());  // that is not the surface's fault
}

}  // namespace
}  // namespace gelatin
