#pragma once

#include "gl/program.h"
#include "gl/readback.h"
#include "gpu/model_buffers.h"
#include "gpu/node_buffers.h"
#include "model/solver.h"

namespace gelatin::gpu {

/// Watches the nodes: shaders/sim/measure/watch_nodes.comp. Its results are read back through a fence.
class WatchNodes {
public:
    WatchNodes();

    /// The next run needs a storage barrier before it; a step has many.
    void run(const ModelBuffers& model, const NodeBuffers& nodes, std::uint32_t step_number,
             double most_energy) const;

    /// The result until now if `wait`, otherwise as far as it has arrived; starts reading back newer results.
    Alarm alarm(bool wait);
    void forget();

private:
    gl::Program program_;
    gl::Buffer<Alarm> alarm_;  // one element
    gl::Readback readback_;
    Alarm known_ = kNoAlarm;
};

}  // namespace gelatin::gpu
