#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "mesh/tet_mesh.h"
#include "model/model.h"

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
inline constexpr const char* kImplicitStage = "implicit step";

/// Three times `scale` of this sphere in a grid, slightly damped so that both terms of the force count.
std::shared_ptr<const Model> make_sphere_grid(const TetMesh& sphere, int scale);

/// Every stage on every backend. @param use_gl needs a context. @param step of the explicit stages [s]
std::vector<KernelCase> kernel_cases(const std::shared_ptr<const Model>& model, double step, bool use_gl);

}  // namespace gelatin
