#include "bench/result.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace gelatin {

BenchSpread BenchResult::spread() const {
    const auto count = static_cast<double>(fps.size());
    const double mean = std::accumulate(fps.begin(), fps.end(), 0.0) / count;
    double squares = 0.0;
    for (const double value : fps) squares += (value - mean) * (value - mean);
    const auto [least, most] = std::minmax_element(fps.begin(), fps.end());
    return {mean, fps.size() > 1 ? std::sqrt(squares / (count - 1.0)) : 0.0, *least, *most};
}

std::string bench_label(std::size_t scene, const BenchSystem& system, bool drawn) {
    return fmt::format("{}, {}, {}", bench_scenes()[scene].name, system.name, drawn ? "drawn" : "undrawn");
}

const BenchResult* PaperBench::find(std::size_t scene, const std::string& system, bool drawn) const {
    const auto found = std::find_if(results.begin(), results.end(), [&](const BenchResult& result) {
        return result.scene == scene && result.system.name == system && result.drawn == drawn;
    });
    return found == results.end() ? nullptr : &*found;
}

std::optional<double> PaperBench::ratio(std::size_t scene, const BenchComparison& comparison,
                                        bool drawn) const {
    const BenchResult* fast = find(scene, comparison.fast, drawn);
    const BenchResult* slow = find(scene, comparison.slow, drawn);
    if (fast == nullptr || slow == nullptr) return std::nullopt;
    return fast->spread().mean / slow->spread().mean;
}

}  // namespace gelatin
