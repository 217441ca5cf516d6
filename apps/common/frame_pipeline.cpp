#include "common/frame_pipeline.h"

#include <tbb/task_group.h>

namespace gelatin {

void FramePipeline::advance_beside(const std::function<void()>& draw) {
    if (simulator_.uses_gl()) {
        draw();
        simulator_.advance_frame();
        return;
    }
    tbb::task_group simulation;
    simulation.run([this] { simulator_.advance_frame(); });
    try {
        draw();
    } catch (...) {
        simulation.wait();
        throw;
    }
    simulation.wait();
}

}  // namespace gelatin
