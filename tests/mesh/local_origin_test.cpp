// Coordinates far from the origin.
#include "mesh/local_origin.h"

#include "mesh/surface_file_fixture.h"

namespace gelatin {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

class LocalOriginTest : public SurfaceFileFixture {
protected:
    SurfaceMesh moved(const SurfaceMesh& from) {
        notes_.clear();
        SurfaceMesh mesh = from;
        move_near_origin(mesh, notes_);
        return mesh;
    }
};

// Text has all digits; single precision would not keep any edge of this cube.
TEST_F(LocalOriginTest, KeepsTheShapeOfTextFilesFarAway) {
    write_surface(folder_.path() / "near.obj", cube({0, 0, 0}, 0.5));
    for (const char* name : {"a.obj", "a.off", "a.ply"}) {
        write_surface(folder_.path() / name, cube({400000.25, 5000000.5, 100}, 0.5));
        notes_.clear();
        const SurfaceMesh mesh = read_surface(folder_.path() / name, notes_);
        EXPECT_EQ(mesh.positions.size(), 8u);
        EXPECT_TRUE(measure_openness(mesh).is_closed());
        EXPECT_DOUBLE_EQ(signed_volume(mesh), 0.125);
        EXPECT_THAT(notes_, ElementsAre(HasSubstr("moved by (-400000.5, -5000000.8, -100.3) to the origin")));
        for (const glm::dvec3& p : mesh.positions) EXPECT_LT(length(p), 1.0);
    }
}

TEST_F(LocalOriginTest, MovesWhatSinglePrecisionWouldRound) {
    constexpr double kSpacing = 1.2e-7;  // of floats, relative to their size
    for (const double size : {1e-6, 1.0, 1e6}) {
        // A hundredth of an edge is the limit.
        const double limit = 0.01 * size / kSpacing;
        EXPECT_EQ(moved(cube({0.9 * limit, 0, 0}, size)).positions[0].x, 0.9 * limit);
        EXPECT_THAT(notes_, IsEmpty());
        const SurfaceMesh far = moved(cube({-1.1 * limit, 0, 0}, size));
        EXPECT_EQ(notes_.size(), 1u);
        for (const glm::dvec3& p : far.positions) EXPECT_LE(length(p), 2.0 * size);
        EXPECT_NEAR(signed_volume(far), size * size * size, 1e-6 * size * size * size);
    }
}

// Neither short edges near the origin nor a few of them decide.
TEST_F(LocalOriginTest, LeavesWhereItIsWhatGainsNothing) {
    SurfaceMesh mesh = cube({-1, -1, -1}, 2.0);
    append(mesh, cube({0.3, 0.3, 0.3}, 1e-9));
    moved(mesh);
    EXPECT_THAT(notes_, IsEmpty());

    SurfaceMesh large = cube({100, 0, 0}, 2.0);
    for (int k = 0; k < 120; ++k) append(large, cube({100.0 + 0.01 * k, 0.1, 0.1}, 0.5));
    append(large, cube({100, 0, 0}, 1e-8));
    moved(large);
    EXPECT_THAT(notes_, IsEmpty());
    moved(SurfaceMesh{});
}

}  // namespace
}  // namespace gelatin
