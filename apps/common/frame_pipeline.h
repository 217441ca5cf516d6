#pragma once

#include <functional>

#include "gelatin/simulator.h"

namespace gelatin {

/// Draws one frame while the next is simulated.
///
/// Where the CPU simulates, its threads advance the frame beside the calling thread, which draws: a step of
/// that backend makes no OpenGL call. A GPU needs no such help, for drawing only tells it what to do. What is
/// computed stays the same bit for bit, with one thread too, which does one after the other.
class FramePipeline {
public:
    explicit FramePipeline(Simulator& simulator) : simulator_(simulator) {}

    /// Runs `draw`, on this thread, and Simulator::advance_frame; returns when both are done.
    /// @pre `draw` uses a RenderView taken before, and nothing of the simulator
    void advance_beside(const std::function<void()>& draw);

private:
    Simulator& simulator_;
};

}  // namespace gelatin
