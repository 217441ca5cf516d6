#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "model/solver.h"

namespace gelatin {

/// A stage of a step, by the name that Simulator::step gives it.
struct BenchStage {
    const char* name;
    void (*run)(Solver& solver, double step);
};

/// Without motion: refit of the boxes, and the query for faces that touch.
std::vector<BenchStage> query_stages();
/// A step of objects that collide with each other.
std::vector<BenchStage> step_stages();
/// Forces, and collisions of objects with themselves only.
std::vector<BenchStage> self_stages();

/// A backend, with this number of threads if it is the CPU's.
struct StageSystem {
    std::string name;  ///< "CPU, 1 thread", "OpenGL"
    bool uses_gl;
    int threads;
};
std::vector<StageSystem> stage_systems(bool use_gl);

/// Runs steps of one model on one system, always from its initial state, and measures each stage by the clock
/// of the device on which it runs.
class StagePlayer {
public:
    StagePlayer(const std::shared_ptr<const Model>& model, const CollisionSettings& collision,
                const StageSystem& system, std::vector<BenchStage> stages);

    /// The time of a step [ms], and how many steps take about 1/50 s. Compiles shaders and faults pages in.
    struct Trial {
        double ms;
        int steps;
    };
    Trial try_out();

    /// Milliseconds per step, by stage: the means over this many steps.
    std::map<std::string, double> sample(int steps);

    /// For the state at the end of the last sample: the results for each object.
    std::vector<ObjectMeasure> measure();
    /// Pairs that did not fit into a device's buffers, as of the last measure().
    std::uint32_t lost_pairs() const { return solver_->lost_pairs(); }

private:
    StageSystem system_;
    std::vector<BenchStage> stages_;
    std::unique_ptr<Solver> solver_;
    double step_;  // [s]
    State start_;
};

}  // namespace gelatin
