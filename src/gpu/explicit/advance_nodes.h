#pragma once

#include "gpu/explicit/integration.h"

namespace gelatin::gpu {

/// Forces and integration fused: shaders/sim/explicit/advance_nodes.comp.
class AdvanceNodes {
public:
    AdvanceNodes(const Model& model, const ExplicitScheme& scheme)
        : program_(
              gl::Program::compute("sim/explicit/advance_nodes.comp", integration_defines(model, scheme))) {}

    /// Ends with the barrier for the next pass, and for gathering the nodes as textures.
    void run(const ModelBuffers& model, const Pass& pass) const;

private:
    gl::Program program_;
};

}  // namespace gelatin::gpu
