#pragma once

#include <string>

#include "bench/paper_cases.h"
#include "bench/windows.h"
#include "common/frame_pipeline.h"
#include "gelatin/simulator.h"
#include "picture/scene_painter.h"

namespace gelatin {

/// One system with one scene, ready to be timed. Needs the context that was current when it was made.
class BenchPlayer {
public:
    BenchPlayer(const Scene& scene, const BenchSystem& system);

    /// Wall-clock seconds for the frames of a window, everything included: steps, and if `drawn` normals,
    /// light and picture; until the GPU has done the last one. Loading the window's state does not count.
    double time_window(const BenchWindow& window, bool drawn);

    const Simulator& simulator() const { return simulator_; }

private:
    void play(int frames, bool drawn);

    int threads_;
    Simulator simulator_;
    ScenePainter painter_;
    FramePipeline pipeline_;
};

/// Size and quality of the pictures: "1280x720, fast".
std::string describe_bench_picture();

}  // namespace gelatin
