#include "bench/samples.h"

#include <algorithm>

namespace gelatin {

BenchSummary summarise(std::vector<double> samples) {
    std::sort(samples.begin(), samples.end());
    const auto percentile = [&](double p) {
        return samples[static_cast<std::size_t>(p * static_cast<double>(samples.size() - 1))];
    };
    return {samples[samples.size() / 2], percentile(0.1), percentile(0.9)};
}

}  // namespace gelatin
