#include "common/scene_input.h"

#include <gtest/gtest.h>

#include "core/file.h"
#include "gelatin/error.h"

namespace gelatin {
namespace {

namespace fs = std::filesystem;

class SceneInputTest : public testing::Test {
protected:
    SceneInputTest() {
        write_file(path("wedge.obj"),
                   "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n");
        write_file(path("ball.toml"),
                   "[[material]]\nname = 'jelly'\n[[object]]\nname = 'ball'\n"
                   "shape = { sphere = 0.5 }\n");
    }
    fs::path path(const std::string& name) const { return folder_.path() / name; }
    std::string problem_with(const SceneInput& input) const {
        try {
            load_input(input);
        } catch (const InvalidInput& error) {
            const std::string text = error.what(), folder = folder_.path().string() + "/";
            return text.starts_with(folder) ? text.substr(folder.size()) : text;
        }
        return "no error";
    }

private:
    const TemporaryFolder folder_;
};

TEST_F(SceneInputTest, IsASceneOrMeshes) {
    EXPECT_EQ(load_input({{path("ball.toml")}}).objects[0].name, "ball");
    const Scene pile = load_input({{path("wedge.obj"), path("wedge.obj")}});
    EXPECT_EQ(pile.objects.size(), 2u);
    EXPECT_EQ(pile.file, path("wedge.obj"));
}

// Whatever is dropped onto the window.
TEST_F(SceneInputTest, SaysWhatIsWrongWithAFile) {
    EXPECT_EQ(problem_with({{path("picture.png")}}), "picture.png: no such file");
    write_file(path("picture.png"), "\x89PNG");
    EXPECT_EQ(problem_with({{path("wedge.obj"), path("picture.png")}}),
              "picture.png: is neither a scene (.toml) nor a mesh (.obj, .stl, .ply, .off, .gltf, .glb, "
              ".node, .ele, .mesh, .msh, .vtk or .vtu)");
    EXPECT_EQ(problem_with({{path("").parent_path()}}),
              path("").parent_path().string() + ": is a folder, not a file");
    EXPECT_EQ(problem_with({{path("none.OBJ")}}), "none.OBJ: no such file");
    EXPECT_EQ(problem_with({}), "there is no scene and no mesh to simulate");
}

TEST_F(SceneInputTest, RefusesAMixture) {
    for (const auto& files : {std::vector{path("wedge.obj"), path("ball.toml")},
                              std::vector{path("ball.toml"), path("wedge.obj")},
                              std::vector{path("ball.toml"), path("ball.toml")}}) {
        EXPECT_EQ(problem_with({files}),
                  "ball.toml: a scene is simulated alone; several files must all be meshes");
    }
}

TEST_F(SceneInputTest, RefusesOptionsOfMeshesForAScene) {
    SceneInput input{{path("ball.toml")}};
    input.meshes.keep_units = true;
    EXPECT_EQ(problem_with(input), "ball.toml: is a scene; --up, --keep-units and --nodes are for meshes");
}

TEST_F(SceneInputTest, OverridesCountForMeshesToo) {
    SceneInput input{{path("wedge.obj")}, {"material.jelly.youngs_modulus=2e5", "simulation.frames=7"}};
    const Scene scene = load_input(input);
    EXPECT_EQ(scene.materials[0].youngs_modulus, 2e5);
    EXPECT_EQ(scene.simulation.frames, 7);
    EXPECT_EQ(fs::weakly_canonical(std::get<FileShape>(scene.objects[0].shape).file),
              fs::weakly_canonical(path("wedge.obj")));
    input.overrides = {"object.wege.scale=2"};
    EXPECT_EQ(problem_with(input),
              "--set object.wege.scale=2: no object is called \"wege\" (did you mean "
              "\"wedge\"?); there are 1, numbered from 0");
}

}  // namespace
}  // namespace gelatin
