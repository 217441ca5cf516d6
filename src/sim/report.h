#pragma once

#include <string>
#include <utility>
#include <vector>

#include "gelatin/simulator.h"
#include "model/setting_names.h"

namespace gelatin {

/// The content of `gelatin run --stats`.
struct RunReport {
    std::string scene;    ///< the file
    std::string backend;  ///< "gl" or "cpu"
    std::string device;
    SimulationSettings settings;
    CollisionSettings collision;
    int substeps = 1;        ///< steps per frame, as chosen
    double step_size = 0.0;  ///< [s]
    Counts counts;
    std::vector<std::string> objects;    ///< names, in the order of FrameStatistics::volume_ratio
    std::vector<std::string> colliders;  ///< names, in the order of the scene
    std::vector<FrameStatistics> frames;
    double seconds = 0.0;          ///< wall clock over all timed frames [s]
    std::vector<double> frame_ms;  ///< wall clock of each frame, recording included [ms]
    std::vector<std::pair<std::string, std::vector<double>>> stage_ms;  ///< of each run of a stage [ms]
};

/// The part of a report that is known before the first frame.
RunReport describe_run(const Simulator& simulator);

/// One JSON object, SI units; docs/command-line.md lists its keys.
std::string to_json(const RunReport& report);

/// The smallest value such that `fraction` of the sorted values are not larger (nearest rank); 0 without
/// values.
double percentile(std::vector<double> values, double fraction);

}  // namespace gelatin
