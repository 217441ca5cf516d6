#pragma once

#include "gl/program.h"
#include "gl/readback.h"
#include "gpu/model_buffers.h"
#include "gpu/node_buffers.h"
#include "model/solver.h"

namespace gelatin::gpu {

/// Watches over the nodes: shaders/sim/measure/watch_nodes.comp. What it finds comes back through a fence.
class WatchNodes {
public:
    WatchNodes();

    /// The next run needs a storage barrier before it; a step has many.
    void run(const ModelBuffers& model, const NodeBuffers& nodes, std::uint32_t step_number,
             double most_energy) const;

    /// What was found until now if `wait`, else as far as the GPU has told; starts bringing what is new.
    Alarm alarm(bool wait);
    void forget();

private:
    gl::Program program_;
    gl::Buffer<Alarm> alarm_;  // one element
    gl::Readback readback_;
    Alarm known_ = kNoAlarm;
};

}  // namespace gelatin::gpu
