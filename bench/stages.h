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

/// Moves nothing: refit of the boxes, and the query for faces that touch.
std::vector<BenchStage> query_stages();
/// A step of objects that collide with each other.
std::vector<BenchStage> step_stages();
/// Forces, and collisions of objects with themselves alone.
std::vector<BenchStage> self_stages();

/// A backend, with so many threads if it is the CPU's.
struct StageSystem {
    std::string name;  ///< "CPU, 1 thread", "OpenGL"
    bool uses_gl;
    int threads;
};
std::vector<StageSystem> stage_systems(bool use_gl);

/// Steps one model on one system, always from the state that it starts with, and tells how long each stage
/// takes by the clock of the device that it runs on.
class StagePlayer {
public:
    StagePlayer(const std::shared_ptr<const Model>& model, const CollisionSettings& collision,
                const StageSystem& system, std::vector<BenchStage> stages);

    /// How long time of a step [ms], and how many take about a fiftieth of a second. Compiles shaders and
    /// faults pages in.
    struct Trial {
        double ms;
        int steps;
    };
    Trial try_out();

    /// Milliseconds a step, by stage: the means over so many steps.
    std::map<std::string, double> sample(int steps);

    /// Of the state that the last sample ended with: what was found of each object.
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
