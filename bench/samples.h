#pragma once

#include <string>
#include <vector>

namespace gelatin {

/// What samples of one figure say together.
struct BenchSummary {
    double median, low, high;  ///< of the samples; their 10th and 90th percentile

    double spread() const { return (high - low) / median; }
};
/// @pre samples is not empty
BenchSummary summarise(std::vector<double> samples);

/// A figure beside what is wanted of it.
struct BenchRatio {
    std::string what;
    double value;
    std::string wanted;  ///< ">= 2"; empty where nothing is
};

}  // namespace gelatin
