#include "bench/contact_result.h"

#include <fmt/core.h>

#include <algorithm>
#include <functional>

#include "bench/samples.h"

namespace gelatin {
namespace {

// Programs that run once in each try's solve, and once in each iteration of it.
const std::string kOfSolve = "sim/implicit/begin_rows.comp", kOfIteration = "sim/implicit/solve_product.comp";
constexpr double kDispatchesOfIteration = 3.0;

double median_of(const std::vector<ContactSample>& samples,
                 const std::function<double(const ContactSample&)>& value) {
    std::vector<double> values;
    for (const ContactSample& sample : samples) values.push_back(value(sample));
    return summarise(values).median;
}

}  // namespace

double ContactDispatches::of_part() const {
    return (all.working - kDispatchesOfIteration * iterations) / tries.working;
}

ContactDispatches summarise(const gl::DispatchCounter::Counts& counts, int frames) {
    ContactDispatches sums;
    const auto add = [&](const gl::DispatchCount& count, ContactDispatches::Count& sum) {
        sum.launched += static_cast<double>(count.launched) / frames;
        sum.working += static_cast<double>(count.working) / frames;
    };
    for (const auto& [stage, programs] : counts) {
        const std::string name = stage.substr(stage.find('.') + 1);
        const bool is_known =
            std::find(kContactStages.begin(), kContactStages.end(), name) != kContactStages.end();
        for (const auto& [program, count] : programs) {
            add(count, sums.stages[is_known ? name : kOtherStages]);
            add(count, sums.all);
            if (program == kOfSolve) add(count, sums.tries);
            if (program == kOfIteration) sums.iterations += static_cast<double>(count.working) / frames;
        }
    }
    return sums;
}

double ContactResult::mean() const {
    return median_of(samples, [](const ContactSample& s) { return s.mean(); });
}

double ContactResult::median() const {
    return median_of(samples, [](const ContactSample& s) { return s.median(); });
}

double ContactResult::worst() const {
    return median_of(samples, [](const ContactSample& s) { return s.worst(); });
}

double ContactResult::stage(const std::string& name) const {
    return median_of(samples, [&](const ContactSample& s) {
        if (name != kOtherStages) return s.stages.at(name);
        double rest = s.mean();
        for (const auto& [stage, ms] : s.stages) rest -= ms;
        return rest;
    });
}

double ContactResult::bytes(const std::string& stage) const {
    if (stage == "linearise") return linearise_bytes * (dispatches ? dispatches->tries.working : tries());
    if (stage != "solve") return 0.0;
    // A device's iteration is one for all islands, those included that have ended.
    const double iterations =
        dispatches ? dispatches->iterations : samples.back().multiplied_nodes / static_cast<double>(nodes);
    return iteration_bytes * iterations;
}

std::vector<BenchRatio> ContactBench::ratios() const {
    std::vector<BenchRatio> ratios;
    const auto find = [&](const ContactResult& like, const std::function<bool(const ContactResult&)>& is) {
        const auto found = std::find_if(results.begin(), results.end(), [&](const ContactResult& r) {
            return r.scene == like.scene && is(r);
        });
        return found == results.end() ? nullptr : &*found;
    };
    int most_threads = 0;
    for (const ContactResult& r : results) most_threads = std::max(most_threads, r.system.threads);
    for (const ContactResult& r : results) {
        if (!r.system.uses_gl) continue;
        const ContactResult* host = find(r, [&](const ContactResult& other) {
            return other.scale == r.scale && !other.system.uses_gl && other.system.threads == most_threads;
        });
        const std::string of = fmt::format("{}, {}x: ", r.scene->name, r.scale);
        if (host != nullptr)
            ratios.push_back({of + r.system.name + " / " + host->system.name, r.mean() / host->mean(),
                              "<= 3 on software drivers"});
        ratios.push_back(
            {of + "dispatches with work a part, without iterations", r.dispatches->of_part(), "<= 60"});
    }
    for (const ContactResult& r : results) {
        const ContactResult* least =
            find(r, [&](const ContactResult& other) { return other.system.name == r.system.name; });
        if (least->scale < r.scale)
            ratios.push_back({fmt::format("{}, {}: a copy, {}x / {}x", r.scene->name, r.system.name, r.scale,
                                          least->scale),
                              r.mean() / r.scale / (least->mean() / least->scale), "1 is linear"});
    }
    return ratios;
}

}  // namespace gelatin
