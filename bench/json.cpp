#include <nlohmann/json.hpp>

#include "bench/report.h"
#include "gelatin/version.h"
#include "sim/report.h"

namespace gelatin {
namespace {

using Json = nlohmann::ordered_json;  // keys stay in the documented order

Json settings_json(const PaperBench& bench) {
    return {{"runs", bench.options.runs},
            {"whole_limit", bench.options.whole_limit},
            {"windows", bench.options.windows},
            {"window_frames", bench.options.window_frames},
            {"picture", bench.picture}};
}

Json scene_json(const BenchSceneFacts& facts) {
    return {{"name", bench_scenes()[facts.scene].name},
            {"objects", facts.counts.objects},
            {"nodes", facts.counts.nodes},
            {"springs", facts.counts.springs},
            {"faces", facts.counts.faces},
            {"frames", facts.frames},
            {"contact_free_frames", facts.contact_free_frames}};
}

Json result_json(const BenchResult& result) {
    const BenchSpread spread = result.spread();
    return {{"scene", bench_scenes()[result.scene].name},
            {"system", result.system.name},
            {"drawn", result.drawn},
            {"backend", result.backend},
            {"device", result.device},
            {"forces", name_of(result.system.forces)},
            {"broad_phase", name_of(result.system.broad_phase)},
            {"sampled", result.sampled},
            {"windows", result.window_count},
            {"window_frames", result.window_frames},
            {"fps",
             {{"mean", spread.mean},
              {"standard_deviation", spread.standard_deviation},
              {"min", spread.least},
              {"max", spread.most},
              {"runs", result.fps}}},
            {"paper_fps", result.paper_fps()}};
}

Json ratio_json(const PaperBench& bench, std::size_t scene, const BenchComparison& comparison) {
    Json json{
        {"what", comparison.name}, {"scene", bench_scenes()[scene].name}, {"paper", comparison.paper[scene]}};
    for (const bool drawn : {true, false}) {
        const std::optional<double> ratio = bench.ratio(scene, comparison, drawn);
        if (ratio) json[drawn ? "drawn" : "undrawn"] = *ratio;
    }
    return json;
}

}  // namespace

std::string bench_json(const PaperBench& bench) {
    Json scenes = Json::array(), results = Json::array(), ratios = Json::array();
    for (const BenchSceneFacts& facts : bench.scenes) scenes.push_back(scene_json(facts));
    for (const BenchResult& result : bench.results) results.push_back(result_json(result));
    for (const BenchComparison& comparison : bench_comparisons()) {
        for (const BenchSceneFacts& facts : bench.scenes)
            ratios.push_back(ratio_json(bench, facts.scene, comparison));
    }
    const Json document = {{"gelatin", {{"version", version()}, {"commit", commit()}}},
                           {"benchmark", "paper"},
                           {"machine", machine_json(bench.machine)},
                           {"settings", settings_json(bench)},
                           {"scenes", scenes},
                           {"results", results},
                           {"ratios", ratios}};
    return document.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace gelatin
