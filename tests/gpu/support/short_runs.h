#pragma once

#include <functional>
#include <vector>

#include "gelatin/scene.h"
#include "gelatin/simulator.h"

namespace gelatin::test {

/// A short run on OpenGL. All of them together take every path of the program that has a barrier, and compile
/// every shader with all the defines that the program has for it.
struct ShortRun {
    const char* name;
    std::function<void(Scene&)> change = [](Scene&) {};         ///< of the scene that all share
    std::function<void(Simulator&)> begin = [](Simulator&) {};  ///< before the first frame
    bool is_drawn = false;                                      ///< in both qualities, with all overlays
    Backend backend = Backend::gl;                              ///< the CPU simulates, OpenGL draws
};
std::vector<ShortRun> short_runs();

/// Runs it in the current context.
void play(const ShortRun& run);

}  // namespace gelatin::test
