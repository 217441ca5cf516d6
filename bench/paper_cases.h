#pragma once

#include <array>
#include <string>
#include <vector>

#include "gelatin/simulator.h"

namespace gelatin {

/// Which frames of a scene count: all, or those before the first faces collide (the paper's Table 4).
enum class BenchPart { whole_run, until_contact };

constexpr std::size_t kBenchScenes = 2;

/// One of the paper's simulations (4.2).
struct BenchScene {
    const char* file;  ///< in the folder of scenes
    const char* name;
};
const std::array<BenchScene, kBenchScenes>& bench_scenes();

/// One system: a combination of algorithms and backend, the paper's or a fast one.
struct BenchSystem {
    std::string name;
    Backend backend;
    ForceMethod forces;
    BroadPhase broad_phase;
    int threads;  ///< of the simulation; 0: all
    BenchPart part;
    std::array<double, kBenchScenes>
        paper_fps;  ///< as published; for our own systems that of the nearest one in the paper

    /// `scene` as this system simulates it.
    Scene configure(Scene scene) const;
};

/// In the order of the report. Without a software driver, `fast` runs on OpenGL itself and has no
/// counterpart.
std::vector<BenchSystem> bench_systems(bool software_gl);

/// The speed of one system relative to another.
struct BenchComparison {
    const char* name;
    const char* fast;  ///< systems
    const char* slow;
    std::array<double, kBenchScenes> paper;  ///< the paper's ratio
};
const std::vector<BenchComparison>& bench_comparisons();

}  // namespace gelatin
