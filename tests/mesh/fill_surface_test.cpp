#include "mesh/fill_surface.h"

#include <gmock/gmock.h>

#include <cstdlib>
#include <string>

#include "core/file.h"
#include "gelatin/error.h"
#include "mesh/shapes.h"
#include "mesh/tetrahedralise.h"

namespace gelatin {
namespace {

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
