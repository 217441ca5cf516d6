#include "viewer/scene_source.h"

#include <gtest/gtest.h>

#include "core/file.h"
#include "gelatin/error.h"

namespace gelatin::viewer {
namespace {

std::string problem_with(const std::filesystem::path& file) {
    try {
        open_scene(file, {});
    } catch (const InvalidInput& error) {
        return error.what();
    }
    return "no error";
}

// Whatever is dropped onto the window.
TEST(SceneSource, SaysWhatIsWrongWithAFile) {
    const TemporaryFolder folder;
    const std::filesystem::path picture = folder.path() / "picture.png";
    EXPECT_EQ(problem_with(picture), picture.string() + ": no such file");
    write_file(picture, "\x89PNG");
    EXPECT_EQ(problem_with(picture),
              picture.string() +
                  ": is neither a scene (.toml) nor a mesh (.obj, .stl, .ply, .off, .node, .ele, "
                  ".mesh or .msh)");
    EXPECT_EQ(problem_with(folder.path()), folder.path().string() + ": is a folder, not a file");
    EXPECT_EQ(problem_with(folder.path() / "none.OBJ"),
              (folder.path() / "none.OBJ").string() + ": no such file");
}

// One that is as large as furniture stays as it is; its lowest point is a quarter of its height above the
// floor.
TEST(SceneSource, AMeshFallsALittleWay) {
    const TemporaryFolder folder;
    const std::filesystem::path file = folder.path() / "wedge.obj";
    const auto scene_of = [&](const char* vertices) {
        write_file(file, std::string(vertices) + "f 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n");
        return scene_of_mesh(file);
    };
    const Scene usual = scene_of("v 0 1 0\nv 1 1 0\nv 0 3 0\nv 0 1 1\n");
    EXPECT_EQ(usual.objects[0].scale, 1.0);
    EXPECT_EQ(usual.objects[0].position, glm::dvec3(-0.5, -0.5, -0.5));
    const Scene large = scene_of("v 0 0 0\nv 100 0 0\nv 0 100 0\nv 0 0 50\n");
    EXPECT_EQ(large.objects[0].scale, 0.01);
    EXPECT_EQ(large.objects[0].name, "wedge");
}

}  // namespace
}  // namespace gelatin::viewer
