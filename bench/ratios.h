#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

namespace gelatin {

/// A figure, and its wanted value.
struct BenchRatio {
    std::string what;
    double value;
    std::string wanted;  ///< ">= 2"; empty for none
};

/// As Markdown that is also legible as plain text.
std::string ratio_table(const std::vector<BenchRatio>& ratios);

nlohmann::ordered_json ratios_json(const std::vector<BenchRatio>& ratios);

}  // namespace gelatin
