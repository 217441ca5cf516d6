#include <map>
#include <set>

#include "apps/program_test.h"

namespace gelatin::test {
namespace {

using nlohmann::json;
using testing::Gt;
using testing::HasSubstr;
using testing::Not;

// With two small balls on a slab on a floor in place of each scene. The heavy upper one presses the lower
// one.
class BenchContact : public DrawingProgramTest {
protected:
    BenchContact() {
        std::filesystem::create_directory(path("small"));
        for (const char* name : {"scene_a", "scene_b", "pile", "rain"}) write_scene(name, "");
    }

    void write_scene(const std::string& name, const std::string& simulation) const {
        write("small/" + name + ".toml",
              "[simulation]\n" + simulation +
                  "frames = 90\n[[material]]\nname = 'jelly'\nyoungs_modulus = 1e5\n"
                  "[[object]]\nname = 'lower'\nshape = { sphere = 0.5, frequency = 3 }\n"
                  "position = [0, 0.7, 0]\n"
                  "[[object]]\nname = 'upper'\nshape = { sphere = 0.5, frequency = 3 }\n"
                  "position = [0, 1.67, 0]\n"
                  "[[collider]]\nname = 'slab'\nshape = { box = [3, 0.2, 3] }\nposition = [0, 0.1, 0]\n"
                  "[[collider]]\nshape = { plane = [0, 1, 0] }\n");
    }

    ProgramResult bench(const std::vector<std::string>& more) const {
        std::vector<std::string> arguments{"bench",  "contact", "--scenes", "small",
                                           "--runs", "1",       "--frames", "2"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        return run(arguments);
    }

    static json find(const json& bench, const std::string& system, int scale = 1) {
        for (const json& result : bench["results"])
            if (result["system"] == system && result["scale"] == scale) return result;
        return {};
    }
    static double ratio(const json& bench, const std::string& what) {
        for (const json& ratio : bench["ratios"])
            if (ratio["what"] == what) return ratio["value"];
        return 0.0;
    }
};

TEST_F(BenchContact, MeasuresStagesOnEverySystem) {
    const ProgramResult result = bench({"--only", "B, ", "--json", "c.json"});
    ASSERT_EQ(result.exit_code, 0) << result.err;
    const json bench = read_json("c.json");
    EXPECT_EQ(bench["benchmark"], "contact");
    std::set<std::string> systems;
    for (const json& row : bench["results"]) {
        const std::string system = row["system"];
        systems.insert(system);
        EXPECT_EQ(row["scene"], "B");
        EXPECT_EQ(row["bodies"], 2);
        EXPECT_EQ(row["first_frame"], 5);
        EXPECT_EQ(row["frames"], 2);
        EXPECT_GT(row["contacts"], 0) << system;
        EXPECT_GE(row["tries"], 1.0) << system;
        EXPECT_GE(row["ms"]["worst"], row["ms"]["mean"]);
        double sum = 0.0;
        for (const char* stage : {"detect", "linearise", "solve", "finish", "guard", "others"})
            sum += row["stages"][stage]["ms"].get<double>();
        EXPECT_NEAR(sum, row["ms"]["mean"].get<double>(), 1e-9 * sum);
        for (const char* stage : {"linearise", "solve"}) EXPECT_GT(row["stages"][stage]["bytes"], 0.0);
        EXPECT_FALSE(row["stages"]["guard"].contains("bytes"));
        EXPECT_GT(bench["memory"][system], 1e8);
        EXPECT_EQ(row.contains("dispatches"), system == "OpenGL");
    }
    EXPECT_EQ(systems.count("CPU, 1 thread"), 1u);
    EXPECT_EQ(systems.count("OpenGL"), 1u);
    EXPECT_EQ(bench["memory"].size(), systems.size());

    const std::string most_threads = *std::prev(systems.end(), 2);  // "CPU, 2 threads", before OpenGL
    EXPECT_DOUBLE_EQ(ratio(bench, "B, 1x: OpenGL / " + most_threads),
                     find(bench, "OpenGL")["ms"]["mean"].get<double>() /
                         find(bench, most_threads)["ms"]["mean"].get<double>());
}

TEST_F(BenchContact, CountsDispatches) {
    ASSERT_EQ(bench({"--only", "B, 1x, OpenGL", "--json", "c.json"}).exit_code, 0);
    const json bench = read_json("c.json");
    const json& dispatches = bench["results"][0]["dispatches"];
    for (const char* which : {"launched", "working"}) {
        double sum = 0.0;
        for (const json& stage : dispatches["stages"]) sum += stage[which].get<double>();
        EXPECT_NEAR(sum, dispatches["all"][which].get<double>(), 1e-9 * sum);
        EXPECT_GE(dispatches["tries"][which], 1.0);
    }
    // What does not apply is launched, too.
    EXPECT_GT(dispatches["all"]["launched"], dispatches["all"]["working"]);
    EXPECT_GE(dispatches["iterations"], dispatches["tries"]["working"]);
    EXPECT_DOUBLE_EQ(dispatches["of_part"],
                     ratio(bench, "B, 1x: dispatches with work a part, without iterations"));
    EXPECT_GT(dispatches["of_part"], 10.0);
}

// On the same plane, each on a slab of its own, and none touches another: as many contacts in each.
TEST_F(BenchContact, MakesCopies) {
    ASSERT_EQ(bench({"--only", "rain", "--no-gl", "--scales", "1,3", "--json", "c.json"}).exit_code, 0);
    const json bench = read_json("c.json");
    EXPECT_EQ(bench["machine"]["opengl"], "none");
    const json one = find(bench, "CPU, 1 thread"), three = find(bench, "CPU, 1 thread", 3);
    EXPECT_EQ(three["bodies"], 6);
    EXPECT_EQ(three["nodes"], 3 * one["nodes"].get<int>());
    EXPECT_EQ(three["faces"], 3 * one["faces"].get<int>());
    EXPECT_THAT(one["contacts"].get<int>(), Gt(0));
    EXPECT_NEAR(three["contacts"].get<double>(), 3 * one["contacts"].get<double>(), one["contacts"]);
    EXPECT_DOUBLE_EQ(ratio(bench, "rain, CPU, 1 thread: a copy, 3x / 1x"),
                     three["ms"]["mean"].get<double>() / 3 / one["ms"]["mean"].get<double>());
}

TEST_F(BenchContact, WritesAReport) {
    const ProgramResult result = bench({"--only", "pile, 1x, OpenGL", "--report", "r.md"});
    ASSERT_EQ(result.exit_code, 0) << result.err;
    const std::string report = read_file(path("r.md"));
    EXPECT_THAT(report, HasSubstr("![Time a frame](r.svg)"));
    EXPECT_THAT(report, HasSubstr(result.out));
    EXPECT_THAT(report, HasSubstr("--runs 1 --scales 1 --only \"pile, 1x, OpenGL\" --frames 2"));
    EXPECT_THAT(report, Not(HasSubstr(path("").string())));
}

TEST_F(BenchContact, RefusesWhatItCannotDo) {
    EXPECT_EQ(bench({"--only", "slow"}).exit_code, 2);
    EXPECT_THAT(
        bench({"--only", "slow"}).err,
        HasSubstr("--only = slow: is part of no measurement's name, such as \"A, 1x, CPU, 1 thread\""));
    EXPECT_THAT(bench({"--report", "r.txt"}).err, HasSubstr("--report = r.txt: must end in .md"));
    EXPECT_THAT(bench({"--json", "nowhere/c.json"}).err, HasSubstr("there is no folder nowhere"));
    for (const char* option : {"--runs", "--scales", "--frames"})
        EXPECT_EQ(bench({option, "0"}).exit_code, 2);
    EXPECT_THAT(run({"bench", "contact", "--no-gl", "--scenes", "nowhere"}).err,
                HasSubstr("nowhere/scene_a.toml: no such file"));
    write_scene("scene_b", "solver = 'semi_implicit_euler'\n");
    EXPECT_THAT(bench({"--no-gl", "--only", "B"}).err,
                HasSubstr("scene_b.toml: simulation: must make implicit steps with contact, with substeps = "
                          "\"auto\""));
}

}  // namespace
}  // namespace gelatin::test
