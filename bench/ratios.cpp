#include "bench/ratios.h"

#include <nlohmann/json.hpp>

#include "bench/markdown_table.h"

namespace gelatin {

std::string ratio_table(const std::vector<BenchRatio>& ratios) {
    MarkdownTable table({"", "ratio", "wanted"}, {1, 2});
    for (const BenchRatio& ratio : ratios) table.add({ratio.what, format_figure(ratio.value), ratio.wanted});
    return table.text();
}

nlohmann::ordered_json ratios_json(const std::vector<BenchRatio>& ratios) {
    auto json = nlohmann::ordered_json::array();
    for (const BenchRatio& ratio : ratios)
        json.push_back({{"what", ratio.what}, {"value", ratio.value}, {"wanted", ratio.wanted}});
    return json;
}

}  // namespace gelatin
