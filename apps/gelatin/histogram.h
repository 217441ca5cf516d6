#pragma once

#include <cstddef>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace gelatin {

/// How many values there are in each of several equal intervals; what is outside counts in the nearest one.
class Histogram {
public:
    /// @pre from < to, intervals > 0
    Histogram(double from, double to, std::size_t intervals) : from_(from), to_(to), counts_(intervals) {}

    void add(double value);

    /// { "from": ..., "to": ..., "counts": [...] }
    nlohmann::ordered_json json() const;

private:
    double from_, to_;
    std::vector<std::size_t> counts_;
};

/// A line for each interval with its ends, its count and a bar, whose length is relative to the largest
/// count. Where there is anything, the bar has one mark at least.
/// @param json as Histogram::json makes it @param indent before each line
std::string draw_histogram(const nlohmann::ordered_json& json, const std::string& indent);

}  // namespace gelatin
