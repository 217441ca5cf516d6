#pragma once

#include <map>
#include <string>
#include <vector>

#include "bench/machine.h"
#include "bench/ratios.h"
#include "bench/samples.h"
#include "bench/scaling.h"
#include "bench/scaling_cases.h"

namespace gelatin {

/// The measurement of one scene on one system.
struct ScalingResult {
    ScalingPart part;
    std::string scene;
    BroadPhase broad_phase;
    std::string system;
    std::size_t objects, faces;                          ///< of the scene
    double loading;                                      ///< time to build the model, without its meshes [s]
    std::size_t colliding_faces = 0;                     ///< after the last sample
    std::uint32_t lost_pairs = 0;                        ///< pairs that were not tested for lack of room
    int steps = 0;                                       ///< in a sample
    std::vector<std::map<std::string, double>> samples;  ///< of each stage [ms per step]

    /// Of these stages together [ms per step].
    BenchSummary time(const std::vector<std::string>& stages) const;
    BenchSummary refit() const { return time({"update_boxes"}); }
    BenchSummary query() const { return time({"find_object_pairs", "find_face_collisions"}); }
    /// Of all stages.
    BenchSummary step() const;
};

/// One run of `gelatin bench scaling`.
struct ScalingBench {
    ScalingBenchOptions options;
    BenchMachine machine;
    std::vector<ScalingResult> results;

    std::vector<std::string> systems() const;  ///< that were measured
    std::vector<BenchRatio> ratios() const;
};

}  // namespace gelatin
