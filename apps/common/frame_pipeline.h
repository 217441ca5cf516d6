#pragma once

#include <functional>

#include "gelatin/simulator.h"

namespace gelatin {

/// Draws one frame while the next is simulated.
///
/// If the CPU simulates, its threads advance the frame while the calling thread draws: a step of that backend
/// makes no OpenGL call. On a GPU this is not necessary, because drawing only submits commands. The results
/// stay the same bit for bit, also with a single thread, which does one after the other.
class FramePipeline {
public:
    explicit FramePipeline(Simulator& simulator) : simulator_(simulator) {}

    /// Runs `draw` on this thread, and Simulator::advance_frame; returns when both are done.
    /// @pre `draw` uses an earlier RenderView, and nothing of the simulator
    void advance_beside(const std::function<void()>& draw);

private:
    Simulator& simulator_;
};

}  // namespace gelatin
