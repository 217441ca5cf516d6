// Every barrier of the program is needed, and none is missing: short runs that together reach all of them,
// recorded as the hazard tracker sees them, and played back with each barrier left out in turn.
#include <gmock/gmock.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <variant>
#include <vector>

#include "core/file.h"
#include "gl/hazards.h"
#include "support/gl_fixture.h"
#include "support/scenarios.h"
#include "support/source_path.h"

namespace gelatin {
namespace {

using ::testing::IsEmpty;
using ::testing::Not;

class BarriersHeavy : public test::GlTest {};

std::vector<gl::GpuEvent> record(const test::Scenario& scenario) {
    gl::record_gpu_events();
    test::play(scenario);
    return gl::take_gpu_events();
}

// "src/gpu/collision/respond.cpp:31" of each call of barrier() in src/, from the sources.
std::set<std::string> barriers_of_the_sources() {
    std::set<std::string> sites;
    const std::regex call(R"(\bbarrier\([^)])");
    for (const auto& entry : std::filesystem::recursive_directory_iterator(test::source_path("src"))) {
        const std::string name = entry.path().filename().string();
        if (!name.ends_with(".cpp") || name.starts_with("barrier") || name.starts_with("hazard")) continue;
        std::istringstream lines(read_file(entry.path()));
        int number = 0;
        for (std::string line; std::getline(lines, line);) {
            ++number;
            if (std::regex_search(line.substr(0, line.find("//")), call))
                sites.insert(gl::to_string(gl::CallSite{entry.path().c_str(), number}));
        }
    }
    return sites;
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
    for (const test::Scenario& scenario : test::scenarios()) {
        SCOPED_TRACE(scenario.name);
        const std::vector<gl::GpuEvent> events = record(scenario);
        EXPECT_THAT(gl::take_hazards(), IsEmpty());
        for (const gl::CallSite site : sites_of(events)) {
            bool& needed = is_needed[gl::to_string(site)];
            needed = needed || has_hazard_without(site, events);
        }
    }
    for (const auto& [site, needed] : is_needed)
        EXPECT_TRUE(needed) << site << ": the barrier may be removed without anybody noticing";
    for (const std::string& site : barriers_of_the_sources())
        EXPECT_TRUE(is_needed.contains(site)) << site << ": no scenario reaches the barrier";
}

// What is played back is what happens: a barrier that is not counted in a run is missed there.
TEST_F(BarriersHeavy, AreMissedInARun) {
    const test::Scenario scenario = test::scenarios().front();
    const std::vector<gl::GpuEvent> events = record(scenario);
    const std::set<gl::CallSite> sites = sites_of(events);
    const auto found = std::find_if(sites.begin(), sites.end(),
                                    [&](gl::CallSite site) { return has_hazard_without(site, events); });
    ASSERT_NE(found, sites.end());
    gl::suppress_barrier(*found);
    test::play(scenario);
    gl::count_all_barriers();
    EXPECT_THAT(gl::take_hazards(), Not(IsEmpty()));
}

}  // namespace
}  // namespace gelatin
