#pragma once

#include <vector>

#include "model/model.h"
#include "model/solver.h"
#include "support/step_on_gpu.h"

namespace gelatin::test {

/// What nodes were after each step of a run that somebody watched over.
struct WatchedRun {
    std::vector<NodeArrays>
        steps;          ///< with a guard that is not finite, the first step being number kFirstStep
    float most_energy;  ///< of a node [J]
};
constexpr std::uint32_t kFirstStep = 41;

/// Runs of a lively model: a sound one whose fastest nodes are just as fast as allowed, with a pinned one
/// that is faster; one in which nodes are too fast, the last one most; and one with each coordinate that is
/// not finite in its turn, and worse in the step after.
std::vector<WatchedRun> watched_runs(const Model& model);

Alarm watch_on_cpu(const Model& model, const WatchedRun& run);
Alarm watch_on_gpu(const Model& model, const WatchedRun& run);

/// The same but for rounding of the speed.
bool agree(const Alarm& a, const Alarm& b);

}  // namespace gelatin::test
