// Every barrier of the program is needed, and none is missing: short runs that together reach all of them,
// recorded as the hazard tracker sees them, and played back with each barrier left out in turn.
#include <gmock/gmock.h>

#include <algorithm>
#include <filesystem>
#include <functional>
#include <map>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <variant>
#include <vector>

#include "core/file.h"
#include "gelatin/simulator.h"
#include "gl/hazards.h"
#include "gpu/support/short_runs.h"
#include "support/gl_fixture.h"
#include "support/source_path.h"

namespace gelatin {
namespace {

using ::testing::IsEmpty;
using ::testing::Not;

class BarriersHeavy : public test::GlTest {};

std::vector<gl::GpuEvent> record(const test::ShortRun& run) {
    gl::record_gpu_events();
    test::play(run);
    return gl::take_gpu_events();
}

// "src/gpu/collision/respond.cpp:31" of each line of src/ that `pattern` is found in, in files whose name and
// folder `is_left_out` does not hold for.
std::set<std::string> lines_with(const std::string& pattern,
                                 const std::function<bool(const std::filesystem::path&)>& is_left_out) {
    std::set<std::string> sites;
    const std::regex wanted(pattern);
    for (const auto& entry : std::filesystem::recursive_directory_iterator(test::source_path("src"))) {
        if (entry.path().extension() != ".cpp" || is_left_out(entry.path())) continue;
        std::istringstream lines(read_file(entry.path()));
        int number = 0;
        for (std::string line; std::getline(lines, line);) {
            ++number;
            if (std::regex_search(line.substr(0, line.find("//")), wanted))
                sites.insert(gl::to_string(gl::CallSite{entry.path().c_str(), number}));
        }
    }
    return sites;
}

// The tracker's own files only speak of barriers.
std::set<std::string> barriers_of_the_sources() {
    return lines_with(R"(\bbarrier\([^)])", [](const std::filesystem::path& file) {
        const std::string name = file.filename().string();
        return name.starts_with("barrier") || name.starts_with("hazard");
    });
}

std::set<gl::CallSite> sites_of(const std::vector<gl::GpuEvent>& events) {
    std::set<gl::CallSite> sites;
    for (const gl::GpuEvent& event : events) {
        if (const auto* call = std::get_if<gl::BarrierCall>(&event)) sites.insert(call->where);
    }
    return sites;
}

bool has_hazard_without(gl::CallSite site, const std::vector<gl::GpuEvent>& events) {
    gl::HazardTracker tracker;
    tracker.suppress_barrier(site);
    for (const gl::GpuEvent& event : events) tracker.apply(event);
    return !tracker.take_hazards().empty();
}

// The unbroken program has no hazard; without any one of its barriers it has.
TEST_F(BarriersHeavy, AreAllReachedAndAllNeeded) {
    std::map<std::string, bool> is_needed;  // by site
    for (const test::ShortRun& run : test::short_runs()) {
        SCOPED_TRACE(run.name);
        const std::vector<gl::GpuEvent> events = record(run);
        EXPECT_THAT(gl::take_hazards(), IsEmpty());
        for (const gl::CallSite site : sites_of(events)) {
            bool& needed = is_needed[gl::to_string(site)];
            needed = needed || has_hazard_without(site, events);
        }
    }
    for (const auto& [site, needed] : is_needed)
        EXPECT_TRUE(needed) << site << ": the barrier may be removed without anybody noticing";
    for (const std::string& site : barriers_of_the_sources())
        EXPECT_TRUE(is_needed.contains(site)) << site << ": no run reaches the barrier";
}

// What is played back is what happens: a barrier that is not counted in a run is missed there.
TEST_F(BarriersHeavy, AreMissedInARun) {
    const test::ShortRun run = test::short_runs().front();
    const std::vector<gl::GpuEvent> events = record(run);
    const std::set<gl::CallSite> sites = sites_of(events);
    const auto found = std::find_if(sites.begin(), sites.end(),
                                    [&](gl::CallSite site) { return has_hazard_without(site, events); });
    ASSERT_NE(found, sites.end());
    gl::suppress_barrier(*found);
    test::play(run);
    gl::count_all_barriers();
    EXPECT_THAT(gl::take_hazards(), Not(IsEmpty()));
}

TEST_F(BarriersHeavy, AreNotMissingInTheScenesThatComeWithTheProgram) {
    for (const auto& entry : std::filesystem::directory_iterator(test::source_path("scenes"))) {
        if (entry.path().extension() != ".toml") continue;
        SCOPED_TRACE(entry.path().filename());
        const Scene scene = load_scene(entry.path());
        SimulatorOptions options;
        options.backend = Backend::gl;
        options.use_current_context = true;
        Simulator simulator(scene, options);
        for (int i = 0; i < 3; ++i) simulator.step();
        simulator.begin_statistics();
        simulator.take_statistics();
        EXPECT_THAT(gl::take_hazards(), IsEmpty());
    }
}

// The tracker knows of what goes through the GL layer.
TEST(CommandsToTheGpu, AreGivenByTheGlLayerAlone) {
    const std::set<std::string> lines = lines_with(
        R"(\bgl(Dispatch|Draw(Arrays|Elements|Range)|MultiDraw|MemoryBarrier|(Copy|Clear|Get)?BufferSubData|ClearBufferData))",
        [](const std::filesystem::path& file) { return file.parent_path().filename() == "gl"; });
    EXPECT_THAT(lines, IsEmpty());
}

}  // namespace
}  // namespace gelatin
