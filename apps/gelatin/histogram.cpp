#include "histogram.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

namespace gelatin {

void Histogram::add(double value) {
    const auto last = static_cast<double>(counts_.size() - 1);
    const double place = std::floor((value - from_) / (to_ - from_) * static_cast<double>(counts_.size()));
    ++counts_[static_cast<std::size_t>(std::clamp(place, 0.0, last))];
}

nlohmann::ordered_json Histogram::json() const {
    return {{"from", from_}, {"to", to_}, {"counts", counts_}};
}

std::string draw_histogram(const nlohmann::ordered_json& json, const std::string& indent) {
    constexpr double kWidth = 50.0;  // characters of the longest bar
    const double from = json.at("from").get<double>(), to = json.at("to").get<double>();
    const auto counts = json.at("counts").get<std::vector<std::size_t>>();
    const double step = (to - from) / static_cast<double>(counts.size());
    const auto most =
        static_cast<double>(std::max<std::size_t>(1, *std::max_element(counts.begin(), counts.end())));
    std::string text;
    for (std::size_t k = 0; k < counts.size(); ++k) {
        const double begin = from + static_cast<double>(k) * step;
        const auto length =
            static_cast<std::size_t>(std::ceil(kWidth * static_cast<double>(counts[k]) / most));
        text += fmt::format("{}{:>4.4g} to {:>4.4g}: {:>8}{}{}\n", indent, begin, begin + step, counts[k],
                            length > 0 ? " " : "", std::string(length, '#'));
    }
    return text;
}

}  // namespace gelatin
