#include <nlohmann/json.hpp>

#include "bench/scaling_report.h"
#include "gelatin/version.h"
#include "sim/report.h"

namespace gelatin {
namespace {

using Json = nlohmann::ordered_json;  // keys stay in the order of the documentation

Json stages_json(const ScalingResult& result) {
    Json json = Json::object();
    for (const auto& [stage, ms] : result.samples.front()) {
        const BenchSummary time = result.time({stage});
        json[stage] = {{"median", time.median}, {"low", time.low}, {"high", time.high}};
    }
    return json;
}

Json result_json(const ScalingResult& result) {
    return {{"part", name_of(result.part)},
            {"scene", result.scene},
            {"broad_phase", name_of(result.broad_phase)},
            {"system", result.system},
            {"objects", result.objects},
            {"faces", result.faces},
            {"loading", result.loading},
            {"colliding_faces", result.colliding_faces},
            {"lost_pairs", result.lost_pairs},
            {"samples", result.samples.size()},
            {"steps", result.steps},
            {"stages", stages_json(result)}};
}

}  // namespace

std::string scaling_json(const ScalingBench& bench) {
    Json results = Json::array();
    for (const ScalingResult& result : bench.results) results.push_back(result_json(result));
    const Json document = {{"gelatin", {{"version", version()}, {"commit", commit()}}},
                           {"benchmark", "scaling"},
                           {"machine", machine_json(bench.machine)},
                           {"settings", {{"runs", bench.options.runs}}},
                           {"results", results},
                           {"ratios", ratios_json(bench.ratios())}};
    return document.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace gelatin
