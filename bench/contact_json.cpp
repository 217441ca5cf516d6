#include <nlohmann/json.hpp>

#include "bench/contact_report.h"
#include "gelatin/version.h"

namespace gelatin {
namespace {

using Json = nlohmann::ordered_json;  // keys stay in the order of the documentation

Json count_json(const ContactDispatches::Count& count) {
    return {{"launched", count.launched}, {"working", count.working}};
}

Json dispatches_json(const ContactDispatches& dispatches) {
    Json stages = Json::object();
    for (const auto& [stage, count] : dispatches.stages) stages[stage] = count_json(count);
    return {{"all", count_json(dispatches.all)},
            {"stages", stages},
            {"tries", count_json(dispatches.tries)},
            {"iterations", dispatches.iterations},
            {"of_part", dispatches.of_part()}};
}

Json stages_json(const ContactResult& result) {
    Json stages = Json::object();
    for (const char* stage : kContactStages) {
        stages[stage] = {{"ms", result.stage(stage)}};
        if (result.bytes(stage) > 0.0) stages[stage]["bytes"] = result.bytes(stage);
    }
    stages[kOtherStages] = {{"ms", result.stage(kOtherStages)}};
    return stages;
}

Json result_json(const ContactResult& result) {
    Json json = {{"scene", result.scene->name},
                 {"scale", result.scale},
                 {"system", result.system.name},
                 {"bodies", result.bodies},
                 {"nodes", result.nodes},
                 {"faces", result.faces},
                 {"first_frame", result.scene->first + 1},
                 {"frames", result.frames},
                 {"samples", result.samples.size()},
                 {"contacts", result.contacts()},
                 {"tries", result.tries()},
                 {"ms", {{"mean", result.mean()}, {"median", result.median()}, {"worst", result.worst()}}},
                 {"stages", stages_json(result)}};
    if (result.dispatches) json["dispatches"] = dispatches_json(*result.dispatches);
    return json;
}

}  // namespace

std::string contact_json(const ContactBench& bench) {
    Json results = Json::array();
    for (const ContactResult& result : bench.results) results.push_back(result_json(result));
    const Json document = {{"gelatin", {{"version", version()}, {"commit", commit()}}},
                           {"benchmark", "contact"},
                           {"machine", machine_json(bench.machine)},
                           {"settings", {{"runs", bench.options.runs}}},
                           {"memory", bench.memory_rates},
                           {"results", results},
                           {"left_out", bench.left_out},
                           {"ratios", ratios_json(bench.ratios())}};
    return document.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace gelatin
