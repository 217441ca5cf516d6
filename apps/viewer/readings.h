#pragma once

#include <string>
#include <utility>
#include <vector>

#include "gelatin/simulator.h"
#include "history.h"

namespace gelatin::viewer {

/// What the panels show of a simulation: the latest measurement, and earlier ones.
struct Readings {
    FrameStatistics latest;
    History kinetic, elastic, potential, momentum;
    /// For each stage, time in a step, smoothed [ms].
    std::vector<std::pair<std::string, double>> stages;
    History step_ms;  ///< all stages of a step together

    void add(const FrameStatistics& statistics);

    /// @param times from Simulator::take_stage_times. @return all stages of a step together [ms]; 0 if there
    ///   are none
    double add_stages(const std::vector<std::pair<std::string, std::vector<double>>>& times);

    void clear() { *this = Readings(); }
};

}  // namespace gelatin::viewer
