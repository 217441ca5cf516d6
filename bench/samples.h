#pragma once

#include <string>
#include <vector>

namespace gelatin {

/// A summary of the samples of one figure.
struct BenchSummary {
    double median, low, high;  ///< of the samples; their 10th and 90th percentile

    double spread() const { return (high - low) / median; }
};
/// @pre samples is not empty
BenchSummary summarise(std::vector<double> samples);

/// A figure, and its wanted value.
struct BenchRatio {
    std::string what;
    double value;
    std::string wanted;  ///< ">= 2"; empty for none
};

}  // namespace gelatin
