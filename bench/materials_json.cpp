#include <nlohmann/json.hpp>

#include "bench/beam.h"
#include "bench/materials_report.h"
#include "gelatin/version.h"

namespace gelatin {
namespace {

using Json = nlohmann::ordered_json;  // keys stay in the order of the documentation

Json ms_json(const std::vector<double>& samples) {
    const BenchSummary ms = summarise(samples);
    return {{"median", ms.median}, {"low", ms.low}, {"high", ms.high}, {"samples", samples}};
}

Json time_json(const MaterialTime& time) {
    return {{"material", time.material}, {"solver", time.solver},       {"system", time.system},
            {"step", time.step},         {"ms", ms_json(time.samples)}, {"ratio", time.ratio()}};
}

Json beam_json(const BeamTime& time) {
    return {{"body", time.body},           {"system", time.system}, {"iterations", time.iterations},
            {"ms", ms_json(time.samples)}, {"rate", time.rate()},   {"error", time.error}};
}

Json settings_json(const MaterialBenchOptions& options) {
    return {{"runs", options.runs},
            {"frequency", options.frequency},
            {"beam_nodes", options.beam_nodes},
            {"iterations", options.iterations}};
}

}  // namespace

std::string material_json(const MaterialBench& bench) {
    Json materials = Json::array(), beam = Json::array(), references = Json::array(),
         published = Json::array();
    for (const MaterialTime& time : bench.materials) materials.push_back(time_json(time));
    for (const BeamTime& time : bench.beam.times) beam.push_back(beam_json(time));
    for (const BeamReference& r : bench.beam.references)
        references.push_back(
            {{"body", r.body}, {"parts", r.parts}, {"change", r.change}, {"free_error", r.free_error}});
    for (const PublishedRate& rate : published_beam_rates())
        published.push_back({{"body", rate.body}, {"device", rate.device}, {"rate", rate.rate}});
    const Json document = {{"gelatin", {{"version", version()}, {"commit", commit()}}},
                           {"benchmark", "materials"},
                           {"machine", machine_json(bench.machine)},
                           {"settings", settings_json(bench.options)},
                           {"materials", materials},
                           {"beam", beam},
                           {"references", references},
                           {"published", published}};
    return document.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace gelatin
