#include "apps/program_test.h"
#include "render/image.h"

namespace gelatin::test {
namespace {

using nlohmann::json;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

constexpr const char* kWedge = "v 0 0 0\nv 20 0 0\nv 0 20 0\nv 0 0 20\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n";

class RunMeshes : public ProgramTest {
protected:
    RunMeshes() { write("wedge.obj", kWedge); }
};
class RunMeshesDraws : public DrawingProgramTest {
protected:
    RunMeshesDraws() { write("wedge.obj", kWedge); }
};

// It falls freely for the 0.32 s to the floor, and rests there after three seconds.
TEST_F(RunMeshes, DropsAMeshOntoAFloor) {
    const ProgramResult result =
        run({"run", "wedge.obj", "--nodes", "100", "--backend", "cpu", "--stats", "s.json"});
    ASSERT_EQ(result.exit_code, 0) << result.err;
    EXPECT_THAT(result.err, HasSubstr("gelatin: note: wedge.obj: scaled to an extent of 1 m from 20; "));
    EXPECT_THAT(result.err, HasSubstr("gelatin: note: object 'wedge': filled by TetGen with "));
    const json stats = read_json("s.json");
    EXPECT_EQ(stats["scene"], "wedge.obj");
    ASSERT_EQ(stats["frames"].size(), 181u);
    EXPECT_NEAR(stats["counts"]["nodes"].get<double>(), 100.0, 20.0);
    const double mass = 1000.0 / 6.0, after = 0.25;
    EXPECT_NEAR(stats["frames"][15]["momentum"][1].get<double>(), -9.81 * mass * after, 1.0);
    EXPECT_GT(stats["frames"][180]["contacts"].get<int>(), 0);
    EXPECT_LT(stats["frames"][180]["kinetic_energy"].get<double>(),
              0.01 * stats["frames"][15]["kinetic_energy"].get<double>());
    EXPECT_NEAR(stats["frames"][180]["volume_ratio"]["wedge"].get<double>(), 1.0, 0.1);
}

TEST_F(RunMeshes, QuietPrintsWarningsButNoNotes) {
    const std::vector<std::string> drop = {"run",       "wedge.obj", "--nodes",  "100",
                                           "--backend", "cpu",       "--frames", "1"};
    std::vector<std::string> quiet = drop;
    quiet.emplace_back("--quiet");
    EXPECT_THAT(run(drop).err, AllOf(HasSubstr("gelatin: note: "), HasSubstr("gelatin: warning: ")));
    const ProgramResult result = run(quiet);
    EXPECT_THAT(result.err, AllOf(Not(HasSubstr("gelatin: note: ")), HasSubstr("gelatin: warning: ")));
    EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
}

TEST_F(RunMeshes, TakesSettingsAndCheckpoints) {
    const std::vector<std::string> drop = {"run",     "wedge.obj", "wedge.obj",
                                           "--nodes", "60",        "--backend",
                                           "cpu",     "--set",     "material.jelly.density=500"};
    const auto drop_with = [&](const std::vector<std::string>& more) {
        std::vector<std::string> arguments = drop;
        arguments.insert(arguments.end(), more.begin(), more.end());
        const ProgramResult result = run(arguments);
        EXPECT_EQ(result.exit_code, 0) << result.err;
    };
    drop_with({"--frames", "4", "--stats", "whole.json"});
    drop_with({"--frames", "2", "--checkpoint", "c"});
    drop_with({"--frames", "4", "--resume", "c", "--stats", "rest.json", "--export", "out"});
    const json whole = read_json("whole.json"), rest = read_json("rest.json");
    EXPECT_EQ(whole["counts"]["objects"], 2);
    EXPECT_EQ(whole["frames"][4]["momentum"], rest["frames"][2]["momentum"]);
    EXPECT_NEAR(whole["frames"][4]["momentum"][1].get<double>(), -9.81 * 2.0 * 500.0 / 6.0 * 4.0 / 60.0, 0.5);
    EXPECT_TRUE(exists("out/frame_000004.vtu"));
}

TEST_F(RunMeshes, TakesTetsAsTheyAre) {
    ASSERT_EQ(run({"mesh", "wedge.obj", "-o", "wedge.msh", "--nodes", "60"}).exit_code, 0);
    const ProgramResult result = run({"run", "wedge.msh", "--frames", "1", "--keep-units"});
    ASSERT_EQ(result.exit_code, 0) << result.err;
    EXPECT_THAT(result.err, Not(HasSubstr("note")));
    expect_error({"run", "wedge.msh", "--nodes", "60"}, 2,
                 "wedge.msh: --nodes is for surfaces, and this file has tetrahedra already");
}

TEST_F(RunMeshes, RefusesWrongCalls) {
    expect_error({"run", "missing.obj"}, 2, "missing.obj: no such file");
    expect_error({"run", "wedge.obj", "cube.toml"}, 2,
                 "cube.toml: a scene is simulated alone; several files must all be meshes");
    expect_error({"run", "cube.toml", "--up", "z"}, 2,
                 "cube.toml: is a scene; --up, --keep-units and --nodes are for meshes");
    expect_error({"run", "wedge.obj", "--up", "w"}, 2, "--up = w: must be x, y or z");
    expect_error({"view", "wedge.obj", "--up", "w"}, 2, "--up = w: must be x, y or z");
    expect_error({"run", "wedge.xyz"}, 2, "wedge.xyz: no such file");
    expect_error({"run", "wedge.obj", "--nodes", "3", "--keep-units"}, 2,
                 "wedge.obj: object.wedge.mesher.nodes = 3: must be from 10 to 1000000");
    EXPECT_EQ(run({"run"}).exit_code, 2);
}

TEST_F(RunMeshesDraws, FramesTheWholeFall) {
    for (const char* frame : {"0", "60"}) {
        const ProgramResult result =
            run({"run", "wedge.obj", "--nodes", "60", "--frames", frame, "--image", "a.png", "--size",
                 "160x90", "--set", "object.wedge.color=[1, 0, 0]"});
        ASSERT_EQ(result.exit_code, 0) << result.err;
        const render::Image image = render::read_png(path("a.png"));
        int red = 0, at_edge = 0;
        for (int y = 0; y < image.height; ++y) {
            for (int x = 0; x < image.width; ++x) {
                const std::uint8_t* p = image.at(x, y);
                if (p[0] < p[1] + 60 || p[0] < p[2] + 60) continue;
                ++red;
                if (x == 0 || y == 0 || x == image.width - 1 || y == image.height - 1) ++at_edge;
            }
        }
        EXPECT_GT(red, 300) << frame;
        EXPECT_EQ(at_edge, 0) << frame;
    }
}

}  // namespace
}  // namespace gelatin::test
