#include <map>

#include "apps/program_test.h"

namespace gelatin::test {
namespace {

using nlohmann::json;
using testing::Gt;
using testing::HasSubstr;
using testing::Not;
using testing::UnorderedElementsAre;

// With scenes of one small ball each.
class BenchScaling : public DrawingProgramTest {
protected:
    BenchScaling() {
        std::filesystem::create_directory(path("small"));
        for (const char* name : {"free_fall", "rain"}) {
            write(std::string("small/") + name + ".toml",
                  "[simulation]\nframe_rate = 100\nframes = 1\n[[material]]\nname = "
                  "'jelly'\n[[object]]\nname = "
                  "'ball'\nshape = { sphere = 0.5, frequency = 3 }\nposition = [0, 9, 0]\n");
        }
    }

    ProgramResult bench(const std::vector<std::string>& more) const {
        std::vector<std::string> arguments{"bench",   "scaling",   "--scenes", "small",  "--faces",
                                           "160,640", "--objects", "3,10",     "--runs", "1"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        return run(arguments);
    }

    static json find(const json& bench, const std::string& scene, const std::string& system,
                     const std::string& broad_phase = "hierarchy") {
        for (const json& result : bench["results"]) {
            if (result["scene"] == scene && result["system"] == system &&
                result["broad_phase"] == broad_phase)
                return result;
        }
        return {};
    }

    static double ratio(const json& bench, const std::string& what) {
        for (const json& ratio : bench["ratios"])
            if (ratio["what"] == what) return ratio["value"];
        return 0.0;
    }
};

std::vector<std::string> keys(const json& object) {
    std::vector<std::string> names;
    for (const auto& [key, value] : object.items()) names.push_back(key);
    return names;
}

double stage_time(const json& result, const std::string& stage) {
    return result["stages"][stage]["median"];
}

TEST_F(BenchScaling, MeasuresEveryStageOnEverySystem) {
    const ProgramResult result = bench({"--only", "hierarchy", "--json", "s.json"});
    ASSERT_EQ(result.exit_code, 0) << result.err;
    const json bench = read_json("s.json");
    EXPECT_EQ(bench["benchmark"], "scaling");
    EXPECT_THAT(bench["machine"]["opengl"].get<std::string>(), HasSubstr("OpenGL"));
    std::map<std::string, std::size_t> parts, systems;
    for (const json& row : bench["results"]) {
        const std::string part = row["part"];
        parts[part]++;
        systems[row["system"]]++;
        EXPECT_EQ(row["samples"], 1);
        EXPECT_GE(row["steps"], 1);
        EXPECT_EQ(row["lost_pairs"], 0);
        if (part == "objects") {
            EXPECT_THAT(keys(row["stages"]),
                        UnorderedElementsAre("advance_nodes", "update_boxes", "find_object_pairs",
                                             "find_face_collisions", "respond"));
        } else if (part == "self-collision") {
            EXPECT_THAT(keys(row["stages"]),
                        UnorderedElementsAre("advance_nodes", "update_boxes", "find_self_collisions"));
        } else {
            EXPECT_THAT(keys(row["stages"]),
                        UnorderedElementsAre("update_boxes", "find_object_pairs", "find_face_collisions"));
        }
        EXPECT_GT(stage_time(row, "update_boxes"), 0.0);
    }
    EXPECT_EQ(systems.count("OpenGL"), 1u);
    EXPECT_EQ(systems.count("CPU, 1 thread"), 1u);
    const std::map<std::string, std::size_t> wanted{{"two bodies", 2 * systems.size()},
                                                    {"faces", 2 * systems.size()},
                                                    {"objects", 4 * systems.size()},
                                                    {"self-collision", 2 * systems.size()}};
    EXPECT_EQ(parts, wanted);

    // What touches touches on every system, and what is apart does not.
    for (const auto& [system, count] : systems) {
        for (const char* scene : {"touching", "deep", "160 faces", "640 faces", "10 touching"}) {
            const json colliding = find(bench, scene, system)["colliding_faces"];
            EXPECT_GT(colliding, 0) << scene << ", " << system;
            EXPECT_EQ(colliding, find(bench, scene, "CPU, 1 thread")["colliding_faces"])
                << scene << ", " << system;
        }
        for (const char* scene : {"3 apart", "10 apart", "free_fall", "rain"})
            EXPECT_EQ(find(bench, scene, system)["colliding_faces"], 0) << scene << ", " << system;
    }
    EXPECT_EQ(find(bench, "deep", "OpenGL")["faces"], 16000);
    EXPECT_EQ(find(bench, "640 faces", "OpenGL")["faces"], 1280);
    EXPECT_EQ(find(bench, "10 apart", "OpenGL")["objects"], 10);
}

TEST_F(BenchScaling, ComparesWaysAndSizes) {
    ASSERT_EQ(bench({"--only", "two bodies, touching", "--no-gl", "--json", "w.json"}).exit_code, 0);
    const json ways = read_json("w.json");
    EXPECT_EQ(ways["machine"]["opengl"], "none");
    const json trees = find(ways, "touching", "CPU, 1 thread"),
               brute = find(ways, "touching", "CPU, 1 thread", "boxes");
    EXPECT_EQ(trees["colliding_faces"], brute["colliding_faces"]);
    const auto sum = [](const json& result) {
        double total = 0.0;
        for (const json& stage : result["stages"]) total += stage["median"].get<double>();
        return total;
    };
    EXPECT_DOUBLE_EQ(ratio(ways, "touching, CPU, 1 thread: boxes / hierarchy"), sum(brute) / sum(trees));
    EXPECT_GT(sum(brute), 10.0 * sum(trees));  // 64 million pairs of boxes against a few thousand

    ASSERT_EQ(bench({"--only", "CPU, 1 thread", "--json", "s.json"}).exit_code, 0);
    const json sizes = read_json("s.json");
    const json few = find(sizes, "160 faces", "CPU, 1 thread"),
               many = find(sizes, "640 faces", "CPU, 1 thread");
    EXPECT_NEAR(ratio(sizes, "CPU, 1 thread: refit a face, 640 faces / 160 faces"),
                stage_time(many, "update_boxes") / 1280 / (stage_time(few, "update_boxes") / 320), 1e-9);
    EXPECT_NEAR(ratio(sizes, "CPU, 1 thread: a step an object, 10 apart / 3 apart"),
                sum(find(sizes, "10 apart", "CPU, 1 thread")) / 10 /
                    (sum(find(sizes, "3 apart", "CPU, 1 thread")) / 3),
                1e-9);
}

TEST_F(BenchScaling, WritesAReport) {
    const ProgramResult result = bench({"--only", "apart, hierarchy, OpenGL", "--report", "r.md"});
    ASSERT_EQ(result.exit_code, 0) << result.err;
    const std::string report = read_file(path("r.md"));
    EXPECT_THAT(report, HasSubstr("![Time by size](r.svg)"));
    EXPECT_THAT(report, HasSubstr(result.out));
    EXPECT_THAT(report, HasSubstr("-ffp-contract=off"));
    EXPECT_THAT(result.out, HasSubstr("| 10 apart | OpenGL |"));
    EXPECT_THAT(result.out, Not(HasSubstr("touching")));
}

TEST_F(BenchScaling, RefusesWhatItCannotDo) {
    const std::vector<std::string> call{"bench", "scaling", "--no-gl"};
    const auto refused = [&](const std::vector<std::string>& more) {
        std::vector<std::string> arguments = call;
        arguments.insert(arguments.end(), more.begin(), more.end());
        const ProgramResult result = run(arguments);
        EXPECT_EQ(result.exit_code, 2);
        EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
        return result.err;
    };
    EXPECT_THAT(refused({"--only", "slow"}),
                HasSubstr("--only = slow: is part of no measurement's name, such as \"two bodies, touching, "
                          "hierarchy, CPU, 1 thread\""));
    EXPECT_THAT(refused({"--report", "r.txt"}), HasSubstr("--report = r.txt: must end in .md"));
    EXPECT_THAT(refused({"--json", "nowhere/s.json"}), HasSubstr("there is no folder nowhere"));
    EXPECT_THAT(refused({"--runs", "0"}), HasSubstr("--runs"));
    EXPECT_THAT(refused({"--objects", "10,0"}), HasSubstr("--objects"));
    EXPECT_THAT(refused({"--faces", "12"}), HasSubstr("--faces"));
}

}  // namespace
}  // namespace gelatin::test
