#include "readings.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace gelatin::viewer {
namespace {

constexpr double kNewest = 0.1;  // weight of the newest value in a smoothed one

}  // namespace

void Readings::add(const FrameStatistics& statistics) {
    latest = statistics;
    kinetic.add(static_cast<float>(statistics.kinetic_energy));
    elastic.add(static_cast<float>(statistics.elastic_energy));
    potential.add(static_cast<float>(statistics.potential_energy));
    const auto& p = statistics.momentum;
    momentum.add(static_cast<float>(std::hypot(p[0], p[1], p[2])));
}

// A stage that did not run in every step counts as often as it ran.
double Readings::add_stages(const std::vector<std::pair<std::string, std::vector<double>>>& times) {
    std::size_t steps = 0;
    for (const auto& [name, runs] : times) {
        if (name == "advance_nodes") steps = runs.size();
    }
    if (steps == 0) return 0.0;
    double step_sum = 0.0;
    for (const auto& [name, runs] : times) {
        const double mean = std::accumulate(runs.begin(), runs.end(), 0.0) / static_cast<double>(steps);
        const auto known = std::find_if(stages.begin(), stages.end(),
                                        [&, &stage = name](const auto& s) { return s.first == stage; });
        if (known == stages.end()) {
            stages.emplace_back(name, mean);
        } else {
            known->second += kNewest * (mean - known->second);
        }
        // Stages that run once a picture are not part of a step.
        if (name != "measure" && name != "update_normals" && name != "update_overlays") step_sum += mean;
    }
    step_ms.add(static_cast<float>(step_sum));
    return step_sum;
}

}  // namespace gelatin::viewer
