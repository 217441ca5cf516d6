#include <cmath>
#include <csignal>

#include "apps/program_test.h"
#include "mesh/surface_file.h"
#include "model/assembly/build_model.h"
#include "model/explicit/stability.h"
#include "render/image.h"
#include "sim/checkpoint.h"
#include "support/image_compare.h"

namespace gelatin::test {
namespace {

using nlohmann::json;
using testing::EndsWith;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::StartsWith;

class RunCommand : public ProgramTest {};
using RunCommandHeavy = RunCommand;
class RunCommandDraws : public DrawingProgramTest {};

TEST_F(RunCommand, WritesTheStatisticsOfEveryFrame) {
    const ProgramResult result = run({"run", "cube.toml", "--backend", "cpu", "--stats", "s.json"});
    ASSERT_EQ(result.exit_code, 0) << result.err;
    const json stats = read_json("s.json");
    EXPECT_EQ(stats["scene"], "cube.toml");
    EXPECT_EQ(stats["backend"], "cpu");
    EXPECT_EQ(stats["counts"]["objects"], 1);
    EXPECT_EQ(stats["settings"]["frame_rate"], 100.0);
    const double step = stats["settings"]["step_size"], frame_time = 0.01;
    EXPECT_DOUBLE_EQ(step * stats["settings"]["substeps"].get<int>(), frame_time);
    ASSERT_EQ(stats["frames"].size(), 21u);
    for (int f = 0; f <= 20; ++f) {
        const json& frame = stats["frames"][static_cast<std::size_t>(f)];
        EXPECT_EQ(frame["frame"], f);
        EXPECT_NEAR(frame["time"].get<double>(), f * frame_time, 1e-12);
        // Free fall of the 1,000 kg cube; rounding of the float state alone.
        EXPECT_NEAR(frame["momentum"][1].get<double>(), -9.81 * 1000.0 * f * frame_time, 1.0);
        EXPECT_NEAR(frame["volume_ratio"]["cube"].get<double>(), 1.0, 1e-3);
    }
    EXPECT_GT(stats["timing"]["fps"].get<double>(), 0.0);
    EXPECT_EQ(stats["timing"]["stages"]["advance_nodes"]["runs"].get<int>(),
              20 * stats["settings"]["substeps"].get<int>());
}

// A plate comes down on a block that is held in the air for a second.
TEST_F(RunCommand, TellsWhatBodiesHoldUp) {
    write("press.toml",
          "[simulation]\nframes = 90\n[[material]]\nname = 'jelly'\n"
          "[[object]]\nname = 'block'\nshape = { box = [0.2, 0.2, 0.2] }\nposition = [0, 2, 0]\n"
          "[[object.handle]]\nregion = { plane = [0, 1, 0], offset = 9 }\nrelease = 1\n"
          "[[collider]]\nname = 'plate'\nshape = { box = [1, 0.1, 1] }\nposition = [0, 2.35, 0]\n"
          "keyframes = [{ time = 0 }, { time = 1, move = [0, -0.5, 0] }]\nwhen_blocked = 'stops'\n");
    const ProgramResult result = run({"run", "press.toml", "--backend", "cpu"});
    ASSERT_EQ(result.exit_code, 0) << result.err;
    EXPECT_THAT(result.err, testing::ContainsRegex("warning: collider 'plate' stops at 0\\.4[0-9]* s: "));
    EXPECT_THAT(result.err, testing::ContainsRegex(
                                "warning: collider 'plate' has moved on since 1 s, 0\\.[56][0-9]* s later "
                                "than its keyframes"));
    const ProgramResult goes_on =
        run({"run", "press.toml", "--backend", "cpu", "--set", "collider.0.when_blocked=goes_on"});
    EXPECT_THAT(goes_on.err, HasSubstr("warning: collider 'plate' waits at 0.4"));
    EXPECT_THAT(goes_on.err, Not(HasSubstr("moved on")));
}

TEST_F(RunCommand, TakesOverridesAndFrames) {
    const ProgramResult result = run({"run", "cube.toml", "--frames", "3", "--set", "simulation.solver=rk4",
                                      "--set", "object.cube.velocity=[2, 0, 0]", "--stats", "s.json"});
    ASSERT_EQ(result.exit_code, 0) << result.err;
    const json stats = read_json("s.json");
    EXPECT_EQ(stats["frames"].size(), 4u);
    EXPECT_EQ(stats["settings"]["solver"], "rk4");
    EXPECT_NEAR(stats["frames"][0]["momentum"][0].get<double>(), 2000.0, 0.1);
}

TEST_F(RunCommand, RunsNoFrames) {
    const ProgramResult result = run({"run", "cube.toml", "--frames", "0", "--stats", "s.json"});
    EXPECT_EQ(result.exit_code, 0) << result.err;
    EXPECT_EQ(read_json("s.json")["frames"].size(), 1u);
}

TEST_F(RunCommand, RefusesAFixedStepThatIsTooLong) {
    const ProgramResult result =
        run({"run", "cube.toml", "--set", "simulation.substeps=1", "--set", "simulation.frame_rate=1"});
    EXPECT_EQ(result.exit_code, 2);
    EXPECT_THAT(result.err, HasSubstr("largest"));
}

// Export

TEST_F(RunCommand, ExportsEveryKthFrameFromTheStart) {
    const ProgramResult result =
        run({"run", "cube.toml", "--export", "out", "--format", "obj", "--every", "8", "--quiet"});
    ASSERT_EQ(result.exit_code, 0) << result.err;
    EXPECT_TRUE(exists("out/frame_000000.obj"));
    EXPECT_TRUE(exists("out/frame_000008.obj"));
    EXPECT_TRUE(exists("out/frame_000016.obj"));
    EXPECT_EQ(std::distance(std::filesystem::directory_iterator(path("out")), {}), 3);
    Notes notes;
    const SurfaceMesh start = read_surface(path("out/frame_000000.obj"), notes);
    const SurfaceMesh later = read_surface(path("out/frame_000016.obj"), notes);
    ASSERT_EQ(start.positions.size(), later.positions.size());
    EXPECT_EQ(start.faces, later.faces);
    const double fallen = 0.5 * 9.81 * 0.16 * 0.16;
    for (std::size_t v = 0; v < start.positions.size(); ++v) {
        // First order in the step, at most a hundredth of a second.
        EXPECT_NEAR(start.positions[v].y - later.positions[v].y, fallen, 9.81 * 0.16 * 0.01);
    }
}

TEST_F(RunCommand, ExportsVtuWithTheListOfFrames) {
    ASSERT_EQ(run({"run", "cube.toml", "--frames", "2", "--export", "out", "--every", "1"}).exit_code, 0);
    EXPECT_TRUE(exists("out/frame_000002.vtu"));
    EXPECT_THAT(read_file(path("out/scene.pvd")),
                HasSubstr("timestep=\"0.02\" part=\"0\" file=\"frame_000002.vtu\""));
}

// What is wrong with the outputs is found before anything is simulated.

TEST_F(RunCommand, RefusesOutputsThatCannotBeWritten) {
    const std::string missing = path("missing").string();
    expect_error({"run", "cube.toml", "--stats", "missing/s.json"}, 2,
                 "--stats = missing/s.json: there is no folder missing");
    expect_error({"run", "cube.toml", "--image", missing + "/a.png"}, 2,
                 "--image = " + missing + "/a.png: there is no folder " + missing);
    expect_error({"run", "cube.toml", "--image", "a.jpg"}, 2, "--image = a.jpg: must end in .png");
    expect_error({"run", "cube.toml", "--video", "a.avi"}, 2, "--video = a.avi: must end in .mp4");
    expect_error({"run", "cube.toml", "--checkpoint", "missing/c"}, 2,
                 "--checkpoint = missing/c: there is no folder missing");
    write("taken", "x");
    const ProgramResult result = run({"run", "cube.toml", "--export", "taken"});
    EXPECT_EQ(result.exit_code, 2);
    EXPECT_THAT(result.err, StartsWith("gelatin: error: taken: cannot be made: "));
    // A folder that root may write into, too, but that takes no files.
    const auto expect_folder_error = [&](const std::string& option, const std::string& file,
                                         const std::string& start) {
        const ProgramResult refused = run({"run", "cube.toml", option, file});
        EXPECT_EQ(refused.exit_code, 2) << file;
        EXPECT_THAT(refused.err, StartsWith("gelatin: error: " + start + "/proc: cannot be written: "));
        EXPECT_THAT(refused.err, Not(HasSubstr("Success")));
    };
    for (const auto& [option, file] : {std::pair("--stats", "/proc/s"),
                                       {"--checkpoint", "/proc/s"},
                                       {"--image", "/proc/s.png"},
                                       {"--video", "/proc/s.mp4"},
                                       {"--animation", "/proc/s.pc2"},
                                       {"--record", "/proc/s.gel"}})
        expect_folder_error(option, file, std::string(option) + " = " + file + ": ");
    expect_folder_error("--export", "/proc", "");
}

TEST_F(RunCommand, RefusesUnknownChoices) {
    expect_error({"run", "cube.toml", "--backend", "vulkan"}, 2,
                 "--backend = vulkan: must be auto, gl or cpu");
    expect_error({"run", "cube.toml", "--export", "out", "--format", "vtk"}, 2,
                 "--format = vtk: must be vtu, obj or ply (did you mean \"vtu\"?)");
    expect_error({"run", "cube.toml", "--quality", "fats"}, 2,
                 "--quality = fats: must be auto, high or fast (did you mean \"fast\"?)");
    for (const char* size : {"640", "640x", "x480", "640x480x2", "0x0", "99999x480", "-640x480"}) {
        expect_error({"run", "cube.toml", std::string("--size=") + size}, 2,
                     std::string("--size = ") + size + ": must be WIDTHxHEIGHT with sides from 16 to 8192");
    }
}

TEST_F(RunCommand, FailsCleanlyOnAFullDisk) {
    // Puts the tets into the cache, whose own writing must not meet the limit first.
    ASSERT_EQ(run({"run", "cube.toml", "--frames", "0", "--quiet"}).exit_code, 0);
    settings_.largest_file = 2000;
    const ProgramResult result = run({"run", "cube.toml", "--export", "out", "--format", "obj", "--quiet"});
    EXPECT_EQ(result.exit_code, 1);
    EXPECT_THAT(result.err, HasSubstr("frame_000000.obj: cannot be written"));
    EXPECT_THAT(partial_files(), IsEmpty());
    EXPECT_FALSE(exists("out/frame_000000.obj"));
}

// Progress

TEST_F(RunCommand, TellsEveryTenthWhereStderrIsNoTerminal) {
    const ProgramResult result = run({"run", "cube.toml"});
    EXPECT_EQ(result.exit_code, 0);
    for (int percent = 10; percent <= 100; percent += 10) {
        const std::string line = "gelatin: " + std::string(percent < 100 ? " " : "") +
                                 std::to_string(percent) + "%  frame " + std::to_string(percent / 5) +
                                 " of 20, ";
        EXPECT_THAT(result.err, HasSubstr(line));
    }
    EXPECT_THAT(result.err, Not(HasSubstr("\r")));
    EXPECT_THAT(result.out, HasSubstr("20 frames of 1 object ("));
}

TEST_F(RunCommand, DrawsABarWhereStderrIsATerminal) {
    settings_.error_terminal = true;
    const ProgramResult result = run({"run", "cube.toml"});
    EXPECT_EQ(result.exit_code, 0);
    EXPECT_THAT(result.err, HasSubstr("\r[##############################] 100%  frame 20 of 20, "));
    EXPECT_THAT(result.err, EndsWith("\n"));
}

TEST_F(RunCommand, IsQuietWhenAsked) {
    const ProgramResult result = run({"run", "cube.toml", "--quiet"});
    EXPECT_EQ(result.exit_code, 0);
    EXPECT_EQ(result.out, "");
    EXPECT_EQ(result.err, "");
}

// Ctrl-C. The run would last for hours.

TEST_F(RunCommand, AnInterruptEndsTheRunAndKeepsWhatItHas) {
    settings_.signal_after = "10%";
    settings_.signals = {SIGINT};
    const ProgramResult result = run({"run", "cube.toml", "--frames", "200000", "--stats", "s.json",
                                      "--checkpoint", "c", "--set", "simulation.frame_rate=1e5"});
    EXPECT_EQ(result.exit_code, 1) << result.err;
    EXPECT_THAT(result.err, HasSubstr("gelatin: error: interrupted after frame "));
    EXPECT_THAT(result.err, HasSubstr(" of 200000; what was recorded until then is written\n"));
    const std::size_t frames = read_json("s.json")["frames"].size();
    EXPECT_GE(frames, 20000u);
    EXPECT_LT(frames, 200001u);
    EXPECT_THAT(result.err, HasSubstr("interrupted after frame " + std::to_string(frames - 1) + " of"));
    EXPECT_TRUE(exists("c"));
}

TEST_F(RunCommand, TerminationIsAnInterruptToo) {
    settings_.signal_after = "per frame";
    settings_.signals = {SIGTERM};
    const ProgramResult result = run({"run", "cube.toml", "--frames", "2000000000"});
    EXPECT_EQ(result.exit_code, 1) << result.err;
    EXPECT_THAT(result.err, HasSubstr("interrupted after frame "));
}

TEST_F(RunCommandHeavy, ASecondInterruptKills) {
    settings_.signal_after = "10%";
    settings_.signals = {SIGINT, SIGINT};
    settings_.signal_delay = std::chrono::milliseconds(300);
    // Frames of 1,700 s, which take about a second: the first interrupt waits for the second one's end.
    const ProgramResult result =
        run({"run", "cube.toml", "--frames", "10", "--set", "simulation.frame_rate=6e-4", "--set",
             "simulation.substeps=auto", "--set", "material.jelly.youngs_modulus=1000", "--set",
             "object.cube.shape={box=[1, 1, 1], segments=[10, 10, 10]}"});
    EXPECT_EQ(result.signal, SIGINT) << result.exit_code << result.err;
}

// Divergence

TEST_F(RunCommand, StopsWhenTheSimulationDiverges) {
    // So soft that steps of 300,000 years are stable; and gravity takes positions beyond what a float holds.
    const ProgramResult result =
        run({"run", "cube.toml", "--stats", "s.json", "--checkpoint", "c", "--set",
             "simulation.frame_rate=1e-13", "--set", "material.jelly.youngs_modulus=1e-14", "--set",
             "material.jelly.density=1e14", "--set", "simulation.gravity=[0, 1e15, 0]"});
    EXPECT_EQ(result.exit_code, 3) << result.err;
    EXPECT_THAT(result.err, HasSubstr("gelatin: error: the simulation diverged in step 1 (of frame 1, "));
    EXPECT_THAT(result.err, HasSubstr("of object 'cube'"));
    EXPECT_THAT(result.err,
                HasSubstr("; no checkpoint was saved: --checkpoint FILE --checkpoint-every N saves"));
    EXPECT_EQ(read_json("s.json")["frames"].size(), 1u);  // the start
    EXPECT_FALSE(exists("c"));
}

// A bar that is crushed into a line explodes some frames later.
TEST_F(RunCommand, KeepsWhatWasGoodOfARunThatExplodes) {
    std::vector<std::string> settings = {"object.cube.shape={box=[2, 0.1, 0.1], segments=[20, 1, 1]}",
                                         "simulation.gravity=[0, 0, 0]", "simulation.frames=500"};
    const Model model = build_model(load_scene(path("cube.toml"), settings));
    const double longest = largest_stable_step(SolverKind::semi_implicit_euler, model);
    settings.push_back("simulation.frame_rate=" + std::to_string(1.0 / (0.99 * longest)));
    settings.emplace_back("simulation.substeps=1");
    State state{model.positions, model.velocities, {}};
    for (std::size_t n = 0; n < state.positions.size(); ++n) {
        glm::vec4& p = state.positions[n];
        p = glm::vec4(p.x + 0.6f * p.y + 0.36f * p.z, 9.0f, 0.0f, p.w);
        state.velocities[n].x = n % 2 == 0 ? 0.1f : -0.1f;
    }
    write_checkpoint(path("crushed"), model, {0, 0.0, state});

    const auto explode = [&](std::vector<std::string> arguments) {
        arguments.insert(arguments.begin(),
                         {"run", "cube.toml", "--backend", "cpu", "--quiet", "--resume", "crushed"});
        for (const std::string& setting : settings) arguments.insert(arguments.end(), {"--set", setting});
        return run(arguments);
    };
    const ProgramResult result = explode({"--checkpoint", "c", "--checkpoint-every", "1", "--stats", "s.json",
                                          "--export", "out", "--format", "obj", "--every", "1"});
    EXPECT_EQ(result.exit_code, 3) << result.err;
    EXPECT_THAT(result.err, HasSubstr("; likely cause: "));
    EXPECT_THAT(partial_files(), IsEmpty());
    const json frames = read_json("s.json")["frames"];
    const int last = frames.back()["frame"].get<int>();
    EXPECT_GT(last, 0);
    EXPECT_EQ(frames.size(), static_cast<std::size_t>(last) + 1);
    EXPECT_THAT(result.err,
                EndsWith("; the last good checkpoint is c of frame " + std::to_string(last) + "\n"));
    EXPECT_EQ(read_checkpoint(path("c"), model).frame, last);
    EXPECT_EQ(std::distance(std::filesystem::directory_iterator(path("out")), {}), last + 1);

    EXPECT_THAT(explode({}).err,
                EndsWith("; no checkpoint was saved since crushed, where the run began: --checkpoint FILE "
                         "--checkpoint-every N saves the last good state every N frames\n"));
}

// Checkpoints

TEST_F(RunCommand, UsesNoMoreThreadsThanAllowed) {
    const ProgramResult one =
        run({"run", "cube.toml", "--backend", "cpu", "--frames", "1", "--threads", "1"});
    EXPECT_EQ(one.exit_code, 0) << one.err;
    EXPECT_THAT(one.err, ::testing::HasSubstr("CPU, 1 thread,"));
    EXPECT_EQ(run({"run", "cube.toml", "--threads", "0"}).exit_code, 2);
}

TEST_F(RunCommand, AResumedRunGivesTheSameNumbersAsAWholeOne) {
    const std::vector<std::string> fall = {"--set", "object.cube.position=[0, 0.6, 0]", "--backend", "cpu",
                                           "--quiet"};
    const auto with = [&](std::vector<std::string> arguments) {
        arguments.insert(arguments.end(), fall.begin(), fall.end());
        return run(arguments);
    };
    ASSERT_EQ(with({"run", "cube.toml", "--frames", "40", "--stats", "whole.json"}).exit_code, 0);
    ASSERT_EQ(with({"run", "cube.toml", "--frames", "25", "--checkpoint", "c"}).exit_code, 0);
    const ProgramResult resumed =
        with({"run", "cube.toml", "--frames", "40", "--resume", "c", "--stats", "rest.json"});
    ASSERT_EQ(resumed.exit_code, 0) << resumed.err;
    const json whole = read_json("whole.json"), rest = read_json("rest.json");
    ASSERT_EQ(rest["frames"].size(), 16u);
    for (std::size_t f = 0; f < 16; ++f) {
        json expected = whole["frames"][25 + f], actual = rest["frames"][f];
        EXPECT_NEAR(actual["time"].get<double>(), expected["time"].get<double>(), 1e-12);
        expected.erase("time");
        actual.erase("time");
        EXPECT_EQ(actual, expected);
    }
    EXPECT_GT(whole["frames"][40]["contacts"].get<int>(), 0);  // it did more than fall
}

TEST_F(RunCommand, RefusesACheckpointThatCannotBeResumed) {
    ASSERT_EQ(run({"run", "cube.toml", "--checkpoint", "c", "--quiet"}).exit_code, 0);
    expect_error({"run", "cube.toml", "--resume", "c"}, 2,
                 "c: is of frame 20, the run ends at 20: raise --frames");
    expect_error({"run", "cube.toml", "--resume", "missing"}, 2, "missing: no such file");
    write("damaged", read_file(path("c")).substr(0, 100));
    EXPECT_EQ(run({"run", "cube.toml", "--frames", "30", "--resume", "damaged"}).exit_code, 2);
    EXPECT_EQ(run({"run", "cube.toml", "--frames", "30", "--resume", "c", "--set",
                   "object.cube.shape={sphere=1, frequency=3}"})
                  .exit_code,
              2);
}

// OpenGL

TEST_F(RunCommand, SaysSoWhereThereIsNoOpenGl) {
    settings_.environment.emplace_back("__EGL_VENDOR_LIBRARY_FILENAMES=/nonexistent");
    for (const std::vector<std::string>& wish :
         {std::vector<std::string>{"--backend", "gl"}, {"--image", "a.png", "--backend", "cpu"}}) {
        std::vector<std::string> arguments = {"run", "cube.toml"};
        arguments.insert(arguments.end(), wish.begin(), wish.end());
        const ProgramResult result = run(arguments);
        EXPECT_EQ(result.exit_code, 4) << result.err;
        EXPECT_THAT(result.err, HasSubstr("gelatin: error: "));
        EXPECT_FALSE(exists("a.png"));
    }
    EXPECT_EQ(run({"run", "cube.toml"}).exit_code, 0);  // what does not need it runs
}

TEST_F(RunCommandDraws, SimulatesOnOpenGl) {
    const ProgramResult result =
        run({"run", "cube.toml", "--backend", "gl", "--stats", "s.json", "--gl-debug"});
    ASSERT_EQ(result.exit_code, 0) << result.err;
    const json stats = read_json("s.json");
    EXPECT_EQ(stats["backend"], "gl");
    ASSERT_EQ(stats["frames"].size(), 21u);
    EXPECT_NEAR(stats["frames"][20]["momentum"][1].get<double>(), -9.81 * 1000.0 * 0.2, 1.0);
}

TEST_F(RunCommandDraws, RefusesADeviceThatIsNotThere) {
    EXPECT_EQ(run({"run", "cube.toml", "--backend", "gl", "--device", "1000"}).exit_code, 4);
}

TEST_F(RunCommandDraws, DrawsTheLastFrame) {
    const ProgramResult result = run({"run", "cube.toml", "--image", "last.png", "--size", "160x90", "--set",
                                      "object.cube.color=[1, 0, 0]"});
    ASSERT_EQ(result.exit_code, 0) << result.err;
    const render::Image image = render::read_png(path("last.png"));
    ASSERT_EQ(image.width, 160);
    ASSERT_EQ(image.height, 90);
    int red = 0;
    for (int y = 0; y < image.height; ++y) {
        for (int x = 0; x < image.width; ++x) {
            const std::uint8_t* p = image.at(x, y);
            if (p[0] > p[1] + 60 && p[0] > p[2] + 60) ++red;
        }
    }
    EXPECT_GT(red, 30);            // the cube is in the picture
    EXPECT_LT(red, 160 * 90 / 2);  // and not all of it
}

TEST_F(RunCommandDraws, DrawsInTheQualityAskedFor) {
    const auto picture = [&](const char* quality) {
        const ProgramResult result = run({"run", "cube.toml", "--image", "a.png", "--size", "320x180",
                                          "--quality", quality, "--gl-debug"});
        EXPECT_EQ(result.exit_code, 0) << result.err;
        return render::read_png(path("a.png"));
    };
    const render::Image high = picture("high"), fast = picture("fast");
    const bool is_software =
        nlohmann::json::parse(run({"info", "--json"}).out)["opengl"]["default"]["software"].get<bool>();
    EXPECT_EQ(picture("auto").pixels, is_software ? fast.pixels : high.pixels);
    EXPECT_NE(fast.pixels, high.pixels);
    EXPECT_LT(perceptual_difference(fast, high), 1.0);
}

}  // namespace
}  // namespace gelatin::test
