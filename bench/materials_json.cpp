#include <nlohmann/json.hpp>

#include "bench/materials_report.h"
#include "gelatin/version.h"

namespace gelatin {
namespace {

using Json = nlohmann::ordered_json;  // keys stay in the order of the documentation

Json time_json(const MaterialTime& time) {
    const BenchSummary ms = summarise(time.samples);
    return {{"material", time.material},
            {"solver", time.solver},
            {"system", time.system},
            {"step", time.step},
            {"ms", {{"median", ms.median}, {"low", ms.low}, {"high", ms.high}, {"samples", time.samples}}},
            {"ratio", time.ratio()}};
}

}  // namespace

std::string material_json(const MaterialBench& bench) {
    Json materials = Json::array();
    for (const MaterialTime& time : bench.materials) materials.push_back(time_json(time));
    const Json document = {
        {"gelatin", {{"version", version()}, {"commit", commit()}}},
        {"benchmark", "materials"},
        {"machine", machine_json(bench.machine)},
        {"settings", {{"runs", bench.options.runs}, {"frequency", bench.options.frequency}}},
        {"materials", materials}};
    return document.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace gelatin
