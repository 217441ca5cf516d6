#pragma once

#include <memory>

#include "gpu/descent/block_descent.h"
#include "gpu/descent/match_shapes.h"
#include "gpu/gpu_solver.h"

namespace gelatin::gpu {

/// Moves nodes by steps of implicit Euler (BlockDescent), without contacts between bodies: SharedSolver has
/// those.
class ImplicitSolver : public GpuSolver {
public:
    explicit ImplicitSolver(std::shared_ptr<const Model> model, const CollisionSettings& collision = {},
                            const DescentSettings& descent = {});

protected:
    void advance_nodes(const Step& step) override;

private:
    BlockDescent descent_;
    ShapeMatcher shape_matcher_;  // of bodies that have lost their shape, before they descend
};

}  // namespace gelatin::gpu
