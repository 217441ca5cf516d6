#pragma once

#include <vector>

namespace gelatin {

/// A summary of the samples of one figure.
struct BenchSummary {
    double median, low, high;  ///< of the samples; their 10th and 90th percentile

    double spread() const { return (high - low) / median; }
};
/// @pre samples is not empty
BenchSummary summarise(std::vector<double> samples);

}  // namespace gelatin
