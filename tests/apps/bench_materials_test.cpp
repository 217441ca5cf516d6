#include <algorithm>
#include <set>

#include "apps/program_test.h"

namespace gelatin::test {
namespace {

using nlohmann::json;
using testing::HasSubstr;
using testing::Not;

class BenchMaterials : public DrawingProgramTest {
protected:
    // With small balls, and a short beam.
    ProgramResult bench(const std::vector<std::string>& more) const {
        std::vector<std::string> arguments{"bench", "materials", "--frequency", "3", "--beam-nodes", "3x3x8"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        return run(arguments);
    }
};

std::set<std::string> values(const json& rows, const std::string& key) {
    std::set<std::string> found;
    for (const json& row : rows) found.insert(row[key].get<std::string>());
    return found;
}

double median(std::vector<double> samples) {
    std::sort(samples.begin(), samples.end());
    return samples[samples.size() / 2];
}

// The median of a row's samples over those of another.
double median_ratio(const json& row, const json& other) {
    std::vector<double> ratios;
    for (std::size_t s = 0; s < row["ms"]["samples"].size(); ++s)
        ratios.push_back(row["ms"]["samples"][s].get<double>() / other["ms"]["samples"][s].get<double>());
    return median(ratios);
}

TEST_F(BenchMaterials, ComparesMaterialsOnEverySystem) {
    const ProgramResult result = bench({"--runs", "3", "--iterations", "2", "--json", "m.json"});
    ASSERT_EQ(result.exit_code, 0) << result.err;
    const json bench = read_json("m.json");
    EXPECT_EQ(bench["benchmark"], "materials");
    EXPECT_EQ(bench["settings"]["frequency"], 3);
    const json& rows = bench["materials"];
    const std::set<std::string> materials = values(rows, "material"), systems = values(rows, "system");
    EXPECT_EQ(materials, (std::set<std::string>{"springs, nu 0.25", "springs, nu 0.3", "springs, nu 0.45",
                                                "neo-Hookean, nu 0.25", "neo-Hookean, nu 0.3",
                                                "neo-Hookean, nu 0.25, damped"}));
    EXPECT_EQ(values(rows, "solver"), (std::set<std::string>{"implicit", "semi_implicit_euler"}));
    EXPECT_EQ(systems.count("CPU, 1 thread"), 1u);
    EXPECT_EQ(systems.count("OpenGL"), 1u);
    ASSERT_EQ(rows.size(), materials.size() * systems.size() * 2);

    json first;  // of the same solver and system
    for (const json& row : rows) {
        if (row["material"] == "springs, nu 0.25") first = row;
        EXPECT_EQ(row["solver"], first["solver"]);
        EXPECT_EQ(row["system"], first["system"]);
        const std::vector<double> samples = row["ms"]["samples"];
        ASSERT_EQ(samples.size(), 3u);
        EXPECT_GT(*std::min_element(samples.begin(), samples.end()), 0.0);
        EXPECT_DOUBLE_EQ(row["ms"]["median"], median(samples));
        EXPECT_DOUBLE_EQ(row["ratio"], median_ratio(row, first));
        if (row["solver"] == "implicit") {
            EXPECT_DOUBLE_EQ(row["step"], 1.0 / 60.0);
        } else {
            EXPECT_LT(row["step"].get<double>(), 1.0 / 60.0);
        }
        EXPECT_THAT(result.out, HasSubstr("| " + row["material"].get<std::string>()));
    }
}

TEST_F(BenchMaterials, MeasuresTheErrorsOfABeam) {
    const ProgramResult result = bench({"--runs", "3", "--iterations", "1,40", "--json", "m.json"});
    ASSERT_EQ(result.exit_code, 0) << result.err;
    const json bench = read_json("m.json");
    EXPECT_EQ(bench["settings"]["beam_nodes"], (std::vector<int>{3, 3, 8}));
    ASSERT_EQ(bench["published"].size(), 6u);
    ASSERT_EQ(bench["references"].size(), 2u);
    const json& rows = bench["beam"];
    const std::set<std::string> systems = values(rows, "system");
    ASSERT_EQ(rows.size(), 2 * 2 * systems.size());
    const auto find = [&](const std::string& body, const std::string& system, int iterations) {
        for (const json& row : rows)
            if (row["body"] == body && row["system"] == system && row["iterations"] == iterations) return row;
        return json{};
    };
    for (const json& reference : bench["references"]) {
        const std::string body = reference["body"];
        EXPECT_LT(reference["change"].get<double>(), 1e-3);
        const double unsolved = reference["free_error"];
        for (const std::string& system : systems) {
            const json few = find(body, system, 1), many = find(body, system, 40);
            EXPECT_DOUBLE_EQ(few["rate"].get<double>(), 1e3 / few["ms"]["median"].get<double>());
            EXPECT_LT(many["error"].get<double>(), 0.7 * unsolved) << body << ", " << system;
            EXPECT_GT(many["error"].get<double>(), reference["change"].get<double>());
            // However many threads make it, the step is the same.
            if (system != "OpenGL") {
                EXPECT_EQ(few["error"], find(body, "CPU, 1 thread", 1)["error"]);
            }
        }
        // The device makes the same step.
        const double on_cpu = find(body, "CPU, 1 thread", 40)["error"];
        EXPECT_NEAR(find(body, "OpenGL", 40)["error"].get<double>(), on_cpu, 0.05 * on_cpu);
        EXPECT_THAT(result.out, HasSubstr("| " + body));
    }
}

TEST_F(BenchMaterials, WritesAReport) {
    const ProgramResult result = bench({"--runs", "1", "--iterations", "2", "--no-gl", "--report", "m.md"});
    ASSERT_EQ(result.exit_code, 0) << result.err;
    const std::string report = read_file(path("m.md"));
    EXPECT_THAT(report, HasSubstr(result.out));
    EXPECT_THAT(report, HasSubstr("-ffp-contract=off"));
    EXPECT_THAT(report, Not(HasSubstr("| OpenGL |  ")));
    EXPECT_THAT(report, Not(HasSubstr(path("").string())));
}

TEST_F(BenchMaterials, RefusesWhatItCannotDo) {
    const auto refused = [&](const std::vector<std::string>& more) {
        std::vector<std::string> arguments{"bench", "materials", "--no-gl"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        const ProgramResult result = run(arguments);
        EXPECT_EQ(result.exit_code, 2);
        EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
        return result.err;
    };
    EXPECT_THAT(refused({"--report", "r.txt"}), HasSubstr("--report = r.txt: must end in .md"));
    EXPECT_THAT(refused({"--json", "nowhere/m.json"}), HasSubstr("there is no folder nowhere"));
    EXPECT_THAT(refused({"--runs", "0"}), HasSubstr("--runs"));
    EXPECT_THAT(refused({"--iterations", "10,0"}), HasSubstr("--iterations"));
    EXPECT_THAT(refused({"--frequency", "1"}), HasSubstr("--frequency"));
    EXPECT_THAT(refused({"--beam-nodes", "3x3"}), HasSubstr("--beam-nodes"));
    EXPECT_THAT(refused({"--beam-nodes", "3x1x8"}), HasSubstr("--beam-nodes"));
}

}  // namespace
}  // namespace gelatin::test
