#pragma once

#include <memory>

#include "gpu/gpu_solver.h"

namespace gelatin::gpu {

/// Placeholder.
class ImplicitSolver : public GpuSolver {
public:
    explicit ImplicitSolver(std::shared_ptr<const Model> model, const CollisionSettings& collision = {},
                            const ImplicitSettings& settings = {});

protected:
    void advance_nodes(const Step& step) override;
};

}  // namespace gelatin::gpu
