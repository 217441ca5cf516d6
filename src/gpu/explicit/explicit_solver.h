#pragma once

#include <memory>
#include <optional>
#include <variant>

#include "gpu/elasticity/find_volume_stresses.h"
#include "gpu/explicit/advance_nodes.h"
#include "gpu/explicit/divide_and_merge.h"
#include "gpu/gpu_solver.h"

namespace gelatin::gpu {

/// Moves nodes by the passes of an explicit scheme (model/explicit/explicit_scheme.h).
class ExplicitSolver : public GpuSolver {
public:
    /// @param solver an explicit one
    ExplicitSolver(std::shared_ptr<const Model> model, SolverKind solver, ForceMethod forces,
                   const CollisionSettings& collision = {});

protected:
    void advance_nodes(const Step& step) override;

private:
    // Forces and motion in one kernel, or in the paper's three.
    using Kernels = std::variant<AdvanceNodes, DivideAndMerge>;
    static Kernels make_kernels(const Model& model, const ExplicitScheme& scheme, ForceMethod forces);

    ExplicitScheme scheme_;
    Kernels kernels_;
    NodeBuffers stage_[2], sums_;                             // between the passes of one step
    std::optional<FindVolumeStresses> find_volume_stresses_;  // if the model has a volume term
};

}  // namespace gelatin::gpu
