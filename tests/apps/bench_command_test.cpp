#include <algorithm>
#include <cmath>
#include <map>

#include "apps/program_test.h"

namespace gelatin::test {
namespace {

using nlohmann::json;
using testing::AllOf;
using testing::Gt;
using testing::HasSubstr;
using testing::Lt;
using testing::Not;

class BenchCommand : public ProgramTest {};

// The paper's scenes, small; their spheres meet after some 50 frames.
class BenchPaperHeavy : public DrawingProgramTest {
protected:
    BenchPaperHeavy() {
        const std::string material =
            "[[material]]\nname = 'jelly'\nyoungs_modulus = 1e5\ndensity = 1000\ndamping = 1e-3\n";
        const std::string sphere =
            "shape = { sphere = 0.5, frequency = 3 }\nmesher = { max_volume = 1 }\nmaterial = 'jelly'\n";
        std::filesystem::create_directory(path("small"));
        write("small/free_fall.toml",
              "[simulation]\nsolver = 'semi_implicit_euler'\nframe_rate = 1000\nframes = 5000\n" + material +
                  "[[object]]\nname = 'low'\n" + sphere +
                  "position = [0, 0.5, 0]\n[[object]]\nname = 'high'\n" + sphere +
                  "position = [0, 1.55, 0]\nvelocity = [0, -2, "
                  "0]\n[[collider]]\nshape = { plane = [0, 1, 0] }\n");
        write("small/collision.toml",
              "[simulation]\nsolver = 'semi_implicit_euler'\nframe_rate = 1000\nframes = 5000\ngravity = [0, "
              "0, 0]\n" +
                  material + "[[object]]\nname = 'left'\n" + sphere + "[[object]]\nname = 'right'\n" +
                  sphere + "position = [1.1, 0, 0]\nvelocity = [-2, 0, 0]\n");
    }

    static constexpr int kFrames = 75;

    ProgramResult bench(const std::vector<std::string>& more, int frames = kFrames) const {
        std::vector<std::string> arguments{"bench", "paper",    "--scenes",
                                           "small", "--frames", std::to_string(frames)};
        arguments.insert(arguments.end(), more.begin(), more.end());
        return run(arguments);
    }

    // By the statistics of a run.
    int first_frame_in_contact(const std::string& scene) const {
        run({"run", "small/" + scene + ".toml", "--backend", "cpu", "--frames", std::to_string(kFrames),
             "--stats", "s.json"});
        const json stats = read_json("s.json");
        for (const json& frame : stats["frames"]) {
            if (frame["colliding_faces"] > 0) return frame["frame"];
        }
        return 0;
    }
};

TEST_F(BenchPaperHeavy, MeasuresEverySystemDrawnAndUndrawn) {
    const ProgramResult result = bench({"--runs", "2", "--json", "b.json"});
    ASSERT_EQ(result.exit_code, 0) << result.err;
    const json bench = read_json("b.json");
    EXPECT_EQ(bench["benchmark"], "paper");
    EXPECT_EQ(bench["settings"]["runs"], 2);
    ASSERT_EQ(bench["scenes"].size(), 2u);
    std::map<std::string, int> contact_free;
    for (const json& scene : bench["scenes"]) {
        EXPECT_EQ(scene["frames"], kFrames);
        contact_free[scene["name"]] = scene["contact_free_frames"];
    }
    EXPECT_EQ(contact_free["free fall"], first_frame_in_contact("free_fall") - 1);
    EXPECT_EQ(contact_free["collision"], first_frame_in_contact("collision") - 1);
    for (const auto& [scene, frames] : contact_free) EXPECT_THAT(frames, AllOf(Gt(0), Lt(kFrames))) << scene;

    std::map<std::string, int> rows;
    for (const json& row : bench["results"]) {
        rows[row["system"]]++;
        const json& fps = row["fps"];
        const std::vector<double> runs = fps["runs"];
        ASSERT_EQ(runs.size(), 2u);
        EXPECT_GT(fps["min"].get<double>(), 0.0);
        EXPECT_DOUBLE_EQ(fps["min"], *std::min_element(runs.begin(), runs.end()));
        EXPECT_DOUBLE_EQ(fps["max"], *std::max_element(runs.begin(), runs.end()));
        EXPECT_DOUBLE_EQ(fps["mean"], (runs[0] + runs[1]) / 2.0);
        const double mean = fps["mean"];
        EXPECT_NEAR(fps["standard_deviation"].get<double>(), std::abs(runs[0] - runs[1]) / std::sqrt(2.0),
                    1e-6 * mean);
        EXPECT_EQ(row["sampled"], false);
        const bool until_contact =
            row["system"].get<std::string>().find("until contact") != std::string::npos;
        EXPECT_EQ(row["window_frames"], until_contact ? contact_free[row["scene"]] : kFrames);
    }
    for (const char* system : {"paper, CPU single core", "paper, GPU", "paper, GPU, no boxes, until contact",
                               "paper, GPU, boxes, until contact", "paper, GPU, hierarchy, until contact",
                               "paper, GPU, depth, until contact", "fast"}) {
        EXPECT_EQ(rows[system], 4) << system;  // two scenes, drawn and undrawn
        EXPECT_THAT(result.out, HasSubstr(std::string("| ") + system));
    }
}

TEST_F(BenchPaperHeavy, ComparesAsInThePapersTables) {
    ASSERT_EQ(bench({"--runs", "1", "--only", ", drawn", "--json", "b.json"}, 20).exit_code, 0);
    const json bench = read_json("b.json");
    const auto fps = [&](const std::string& scene, const std::string& system) {
        for (const json& row : bench["results"])
            if (row["scene"] == scene && row["system"] == system) return row["fps"]["mean"].get<double>();
        return 0.0;
    };
    ASSERT_EQ(bench["ratios"].size(), 6u);
    // In percent of time saved the paper's tables say 98.9, 98.0, 84.3 and 79.2.
    const json &table3 = bench["ratios"][0], &table4 = bench["ratios"][3];
    EXPECT_NEAR(table3["paper"].get<double>(), 98.3, 0.05);
    EXPECT_NEAR(bench["ratios"][1]["paper"].get<double>(), 51.9, 0.05);
    EXPECT_NEAR(bench["ratios"][2]["paper"].get<double>(), 6.4, 0.05);
    EXPECT_NEAR(table4["paper"].get<double>(), 4.8, 0.05);
    EXPECT_DOUBLE_EQ(table3["drawn"],
                     fps("free fall", "paper, GPU") / fps("free fall", "paper, CPU single core"));
    EXPECT_DOUBLE_EQ(table4["drawn"], fps("collision", "paper, GPU, boxes, until contact") /
                                          fps("collision", "paper, GPU, no boxes, until contact"));
    EXPECT_FALSE(table3.contains("undrawn"));
}

TEST_F(BenchPaperHeavy, SamplesWhatTakesTooLong) {
    const ProgramResult result = bench({"--runs", "2", "--only", "undrawn", "--whole-limit", "0", "--windows",
                                        "7", "--window-frames", "3", "--json", "b.json"});
    ASSERT_EQ(result.exit_code, 0) << result.err;
    EXPECT_THAT(result.out, HasSubstr("sampled: 7 windows of 3 frames"));
    const json bench_json = read_json("b.json");
    for (const json& row : bench_json["results"]) {
        EXPECT_EQ(row["sampled"], true);
        EXPECT_EQ(row["windows"], 7);
        EXPECT_EQ(row["window_frames"], 3);
    }
}

TEST_F(BenchPaperHeavy, WritesAReport) {
    const ProgramResult result = bench({"--runs", "1", "--only", "free fall, fast", "--report", "r.md"}, 10);
    ASSERT_EQ(result.exit_code, 0) << result.err;
    const std::string report = read_file(path("r.md"));
    EXPECT_THAT(report, HasSubstr("![Frames per second](r.svg)"));
    EXPECT_THAT(report, HasSubstr(result.out));
    EXPECT_THAT(report, HasSubstr("-ffp-contract=off"));
    EXPECT_THAT(report, Not(HasSubstr(path("").string())));
}

TEST_F(BenchPaperHeavy, FindsTheScenes) {
    // The real ones, of the sources: no folder 'scenes' is here.
    const std::vector<std::string> call{"bench", "paper",  "--runs",          "1",      "--frames",
                                        "2",     "--only", "collision, fast", "--json", "b.json"};
    ASSERT_EQ(run(call).exit_code, 0);
    EXPECT_GT(read_json("b.json")["scenes"][0]["nodes"].get<int>(), 5000);
    std::filesystem::rename(path("small"), path("scenes"));
    ASSERT_EQ(run(call).exit_code, 0);
    EXPECT_LT(read_json("b.json")["scenes"][0]["nodes"].get<int>(), 1000);
}

TEST_F(BenchPaperHeavy, RefusesWhatItCannotDo) {
    EXPECT_THAT(bench({"--only", "slow"}).err,
                HasSubstr("--only = slow: is part of no measurement's name, such as "
                          "\"free fall, paper, CPU single core, drawn\""));
    EXPECT_EQ(bench({"--only", "slow"}).exit_code, 2);
    EXPECT_THAT(bench({"--report", "r.txt"}).err, HasSubstr("--report = r.txt: must end in .md"));
    EXPECT_THAT(bench({"--json", "nowhere/b.json"}).err, HasSubstr("there is no folder nowhere"));
    EXPECT_EQ(bench({"--runs", "0"}).exit_code, 2);
    EXPECT_EQ(bench({"--window-frames", "0"}).exit_code, 2);
    EXPECT_THAT(run({"bench", "paper", "--scenes", "nowhere"}).err,
                HasSubstr("nowhere/free_fall.toml: no such file"));
}

TEST_F(BenchCommand, KernelsStillRuns) {
    const ProgramResult result = run({"bench", "kernels", "--no-gl", "--scales", "1", "--runs", "1", "--json",
                                      "k.json", "--report", "k.md"});
    ASSERT_EQ(result.exit_code, 0) << result.err;
    const json kernels = read_json("k.json");
    EXPECT_EQ(kernels["benchmark"], "kernels");
    for (const json& stage : kernels["stages"]) EXPECT_GT(stage["ms"].get<double>(), 0.0);
    EXPECT_THAT(result.out, HasSubstr("CPU, 1 thread: implicit step / fused, 1x"));
    EXPECT_THAT(read_file(path("k.md")), HasSubstr(result.out));
}

}  // namespace
}  // namespace gelatin::test
