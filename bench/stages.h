#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "model/solver.h"

namespace gelatin {

/// A solver whose stages run one by one.
class StagedSolver {
public:
    virtual ~StagedSolver() = default;
    virtual Solver& solver() = 0;
    virtual void advance_nodes(const Step& step) = 0;
    virtual void update_boxes() = 0;
    virtual void find_object_pairs() = 0;
    virtual void find_face_collisions() = 0;
    virtual void find_self_collisions() = 0;
    virtual void respond(double step) = 0;
};

/// A stage of a step, by the name that solvers give it.
struct BenchStage {
    const char* name;
    void (*run)(StagedSolver& solver, double step);
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

    /// Of the state at the end of the last sample.
    Measurement measure();

private:
    StageSystem system_;
    std::vector<BenchStage> stages_;
    std::unique_ptr<StagedSolver> staged_;
    double step_;  // [s]
    State start_;
};

}  // namespace gelatin
