#pragma once

#include "gl/program.h"
#include "gpu/drive/sum_loads.h"
#include "gpu/elasticity/find_volume_stresses.h"
#include "gpu/model_buffers.h"
#include "gpu/node_buffers.h"
#include "model/explicit/explicit_scheme.h"

namespace gelatin::gpu {

/// Input and output of one pass of an explicit scheme on the GPU (cpu::Pass is its counterpart).
struct Pass {
    const ExplicitScheme& scheme;
    int index;
    double step;              ///< h [s]
    const NodeBuffers& base;  ///< at the step's start
    const NodeBuffers& at;    ///< where forces are evaluated
    NodeBuffers& out;
    NodeBuffers& sums;                                    ///< empty for schemes of one pass
    const SumLoads* loads = nullptr;                      ///< null in models without
    const FindVolumeStresses* volume_stresses = nullptr;  ///< the same

    bool is_last() const { return index + 1 == scheme.pass_count; }
};

/// Defines for a shader that includes sim/explicit/integrate_node.glsl.
gl::Defines integration_defines(const Model& model, const ExplicitScheme& scheme);

/// For programs that include sim/explicit/integrate_node.glsl.
void bind_integration(const gl::Program& program, const ModelBuffers& model, const Pass& pass);

}  // namespace gelatin::gpu
