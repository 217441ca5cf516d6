#include "bench/scaling_result.h"

#include <fmt/core.h>

#include <algorithm>

namespace gelatin {
namespace {

double per_face(const BenchSummary& time, const ScalingResult& result) {
    return time.median / static_cast<double>(result.faces);
}
double per_object(const ScalingResult& result) {
    return result.step().median / static_cast<double>(result.objects);
}

// Of one part and system, in the order of their sizes.
std::vector<const ScalingResult*> select(const ScalingBench& bench, ScalingPart part,
                                         const std::string& system) {
    std::vector<const ScalingResult*> selected;
    for (const ScalingResult& result : bench.results)
        if (result.part == part && result.system == system) selected.push_back(&result);
    return selected;
}

void compare_methods(const std::vector<const ScalingResult*>& results, std::vector<BenchRatio>& ratios) {
    for (const ScalingResult* slow : results) {
        if (slow->broad_phase != BroadPhase::boxes) continue;
        for (const ScalingResult* fast : results) {
            if (fast->broad_phase != BroadPhase::hierarchy || fast->scene != slow->scene) continue;
            ratios.push_back({fmt::format("{}, {}: boxes / hierarchy", slow->scene, slow->system),
                              slow->step().median / fast->step().median,
                              slow->scene == "deep" ? ">= 20" : ">= 100"});
        }
    }
}

void compare_faces(const std::vector<const ScalingResult*>& results, std::vector<BenchRatio>& ratios) {
    if (results.size() < 2) return;
    const ScalingResult &small = *results.front(), &large = *results.back();
    const auto add = [&](const char* what, const BenchSummary& few, const BenchSummary& many) {
        ratios.push_back({fmt::format("{}: {} a face, {} / {}", large.system, what, large.scene, small.scene),
                          per_face(many, large) / per_face(few, small), "<= 2, for caches"});
    };
    add("refit", small.refit(), large.refit());
    add("query", small.query(), large.query());
}

// The two largest sizes of each row: with few objects, most have neighbours on one side only.
void compare_objects(const std::vector<const ScalingResult*>& results, std::vector<BenchRatio>& ratios) {
    const auto ends_row = [&](std::size_t r) {
        return r + 1 == results.size() || results[r + 1]->objects <= results[r]->objects;
    };
    for (std::size_t r = 1; r < results.size(); ++r) {
        if (!ends_row(r) || ends_row(r - 1)) continue;
        const ScalingResult &few = *results[r - 1], &many = *results[r];
        ratios.push_back({fmt::format("{}: a step an object, {} / {}", many.system, many.scene, few.scene),
                          per_object(many) / per_object(few), "<= 1.5"});
    }
}

}  // namespace

BenchSummary ScalingResult::time(const std::vector<std::string>& stages) const {
    std::vector<double> sums;
    for (const auto& sample : samples) {
        double sum = 0.0;
        for (const std::string& stage : stages) sum += sample.at(stage);
        sums.push_back(sum);
    }
    return summarise(sums);
}

BenchSummary ScalingResult::step() const {
    std::vector<std::string> stages;
    for (const auto& [stage, ms] : samples.front()) stages.push_back(stage);
    return time(stages);
}

std::vector<std::string> ScalingBench::systems() const {
    std::vector<std::string> systems;
    for (const ScalingResult& result : results)
        if (std::find(systems.begin(), systems.end(), result.system) == systems.end())
            systems.push_back(result.system);
    return systems;
}

std::vector<BenchRatio> ScalingBench::ratios() const {
    std::vector<BenchRatio> ratios;
    for (const std::string& system : systems())
        compare_methods(select(*this, ScalingPart::two_bodies, system), ratios);
    for (const std::string& system : systems())
        compare_faces(select(*this, ScalingPart::faces, system), ratios);
    for (const std::string& system : systems())
        compare_objects(select(*this, ScalingPart::objects, system), ratios);
    return ratios;
}

}  // namespace gelatin
