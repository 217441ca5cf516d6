// What people have in files: whatever its faults, it becomes a body, or there is one line that says why not.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <fstream>
#include <random>

#include "core/file.h"
#include "gelatin/error.h"
#include "mesh/fill_surface.h"
#include "mesh/lattice/broken_surfaces.h"
#include "mesh/surface_file.h"
#include "mesh/topology.h"
#include "support/environment.h"

namespace gelatin {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::Not;

// As programs write it, whatever the numbers; write_surface may refuse some.
std::string obj_of(const SurfaceMesh& surface) {
    std::string text;
    for (const glm::dvec3& p : surface.positions) text += fmt::format("v {} {} {}\n", p.x, p.y, p.z);
    for (const glm::uvec3& f : surface.faces)
        text += fmt::format("f {} {} {}\n", f[0] + 1, f[1] + 1, f[2] + 1);
    return text;
}

std::string binary_stl_of(const SurfaceMesh& surface) {
    std::string bytes(80, ' ');
    const auto append = [&](const auto& value) {
        bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
    };
    append(static_cast<std::uint32_t>(surface.faces.size()));
    for (const glm::uvec3& face : surface.faces) {
        for (int k = 0; k < 3; ++k) append(0.0f);  // the normal
        for (int k = 0; k < 3; ++k) {
            for (int axis = 0; axis < 3; ++axis) append(static_cast<float>(surface.positions[face[k]][axis]));
        }
        append(std::uint16_t{0});
    }
    return bytes;
}

// The largest memory that this process has had [bytes].
double peak_memory() {
    rusage usage{};
    ::getrusage(RUSAGE_SELF, &usage);
    return 1024.0 * static_cast<double>(usage.ru_maxrss);
}

class BrokenFilesTest : public testing::Test {
protected:
    // From a file to a body, as `gelatin run` and `gelatin mesh` do it.
    TetMesh fill(const fs::path& file, MesherKind mesher) const {
        Notes notes;
        const SurfaceMesh surface = read_surface(file, notes);
        MesherSettings settings;
        settings.kind = mesher;
        settings.nodes = 200;
        settings.time_limit = 5.0;
        const TetMesh mesh = fill_surface(surface, settings, file.string(), notes);
        for (const std::string& note : notes) EXPECT_THAT(note, Not(HasSubstr("\n")));
        return mesh;
    }

    // @return how many became bodies
    int try_files(unsigned first, unsigned end) {
        int bodies = 0;
        for (unsigned seed = first; seed < end; ++seed) {
            SCOPED_TRACE(seed);
            const SurfaceMesh surface = BrokenSurfaces(seed).make();
            const bool is_stl = seed % 2 == 1;
            const fs::path file = folder_.path() / (is_stl ? "thing.stl" : "thing.obj");
            std::ofstream(file, std::ios::binary) << (is_stl ? binary_stl_of(surface) : obj_of(surface));
            try {
                // TetGen is asked now and then alone: most of these it refuses.
                const TetMesh mesh = fill(file, seed % 5 == 0 ? MesherKind::tetgen : MesherKind::automatic);
                EXPECT_FALSE(mesh.tets.empty());
                for (const glm::uvec4& tet : mesh.tets) EXPECT_GT(tet_volume(mesh, tet), 0.0);
                EXPECT_EQ(mesh.faces, boundary_faces(mesh.tets));
                ++bodies;
            } catch (const InvalidInput& error) {
                EXPECT_THAT(error.what(), HasSubstr("thing."));
                EXPECT_THAT(error.what(), Not(HasSubstr("\n")));
            }
        }
        EXPECT_LT(peak_memory(), 2e9);
        return bodies;
    }

private:
    const TemporaryFolder folder_;
    const test::EnvironmentVariable cache_{"GELATIN_CACHE_DIR", (folder_.path() / "cache").string()};
};
class BrokenFilesLong : public BrokenFilesTest {};

TEST_F(BrokenFilesTest, GiveABodyOrAnError) {
    EXPECT_GT(try_files(1000, 1004), 0);
}

TEST_F(BrokenFilesLong, GiveABodyOrAnError) {
    EXPECT_GT(try_files(2000, 2300), 80);
}

}  // namespace
}  // namespace gelatin
