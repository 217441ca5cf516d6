#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "mesh/tet_mesh.h"
#include "model/model.h"
#include "model/solver.h"

namespace gelatin {

/// A stage of `gelatin bench kernels`, ready to be timed: `run` enqueues or executes it, `wait` returns when
/// it is done.
struct KernelCase {
    std::string backend, stage;
    double bytes;  ///< that it reads and writes at least
    std::function<void()> run;
    std::function<void()> wait;
    int threads = 0;  ///< 0: all
};

// Names that ratios refer to.
inline constexpr const char* kPlainCore = "plain C++";
inline constexpr const char* kOneThread = "CPU, 1 thread";
inline constexpr const char* kOpenGl = "GL";
inline constexpr const char* kFusedStage = "advance_nodes (fused)";
inline constexpr const char* kDividedStage = "divide and merge";
inline constexpr const char* kDispatchStage = "dispatches of a sweep";

/// Steps of vertex block descent that are timed. Their differences give the cost of a sweep, with its share
/// of what only some sweeps do, of a correction by the coarse level, and of the rest of a step.
struct DescentCase {
    const char* stage;
    DescentSettings settings;
};
inline constexpr DescentCase kFewSweeps{"vbd (2 sweeps alone)", {2, false}};
inline constexpr DescentCase kManySweeps{"vbd (26 sweeps alone)", {26, false}};
inline constexpr DescentCase kWholeStep{"vbd (26 sweeps)", {26}};

/// Three times `scale` of this sphere in a grid, slightly damped so that both terms of the force count.
std::shared_ptr<const Model> make_sphere_grid(const TetMesh& sphere, int scale);

/// Every stage on every backend. @param use_gl needs a context. @param step of the explicit stages [s]
std::vector<KernelCase> kernel_cases(const std::shared_ptr<const Model>& model, double step, bool use_gl);

}  // namespace gelatin
