#include "bench/paper_cases.h"

namespace gelatin {
namespace {

constexpr auto kPaperForces = ForceMethod::divide_and_merge;
constexpr auto kFastForces = ForceMethod::fused;
constexpr auto kFastPhase = BroadPhase::hierarchy;
constexpr std::array<double, kBenchScenes> kPaperCpu{1.34, 4.2}, kPaperGpu{131.66, 218.11};  // Table 3
constexpr std::array<double, kBenchScenes> kWithoutBoxes{39.11, 71.38},
    kWithBoxes{249.45, 343.82};  // Table 4

constexpr const char* kCpuName = "paper, CPU single core";
constexpr const char* kGpuName = "paper, GPU";
constexpr const char* kWithoutBoxesName = "paper, GPU, no boxes, until contact";
constexpr const char* kWithBoxesName = "paper, GPU, boxes, until contact";
constexpr const char* kHierarchyName = "paper, GPU, hierarchy, until contact";  // its chapter 5
constexpr const char* kDepthName = "paper, GPU, depth, until contact";
constexpr const char* kFastName = "fast";

std::array<double, kBenchScenes> ratio(const std::array<double, kBenchScenes>& fast,
                                       const std::array<double, kBenchScenes>& slow) {
    return {fast[0] / slow[0], fast[1] / slow[1]};
}

}  // namespace

const std::array<BenchScene, kBenchScenes>& bench_scenes() {
    static const std::array<BenchScene, kBenchScenes> scenes{
        {{"free_fall.toml", "free fall"}, {"collision.toml", "collision"}}};
    return scenes;
}

Scene BenchSystem::configure(Scene scene) const {
    scene.simulation.forces = forces;
    scene.collision.broad_phase = broad_phase;
    return scene;
}

std::vector<BenchSystem> bench_systems(bool software_gl) {
    using enum BenchPart;
    std::vector<BenchSystem> systems{
        {kCpuName, Backend::cpu, kPaperForces, BroadPhase::boxes, 1, whole_run, kPaperCpu},
        {kGpuName, Backend::gl, kPaperForces, BroadPhase::boxes, 0, whole_run, kPaperGpu},
        {kWithoutBoxesName, Backend::gl, kPaperForces, BroadPhase::none, 0, until_contact, kWithoutBoxes},
        {kWithBoxesName, Backend::gl, kPaperForces, BroadPhase::boxes, 0, until_contact, kWithBoxes},
        {kHierarchyName, Backend::gl, kPaperForces, BroadPhase::hierarchy, 0, until_contact, kWithBoxes},
        {kDepthName, Backend::gl, kPaperForces, BroadPhase::depth, 0, until_contact, kWithBoxes},
        {kFastName, Backend::automatic, kFastForces, kFastPhase, 0, whole_run, kPaperGpu},
    };
    if (software_gl) {
        systems.push_back({"fast, GL", Backend::gl, kFastForces, kFastPhase, 0, whole_run, kPaperGpu});
    }
    return systems;
}

const std::vector<BenchComparison>& bench_comparisons() {
    static const std::vector<BenchComparison> comparisons{
        {"Table 3: GPU / CPU single core", kGpuName, kCpuName, ratio(kPaperGpu, kPaperCpu)},
        {"Table 4: boxes / no boxes", kWithBoxesName, kWithoutBoxesName, ratio(kWithBoxes, kWithoutBoxes)},
        {"fast / CPU single core", kFastName, kCpuName, ratio(kPaperGpu, kPaperCpu)},
    };
    return comparisons;
}

}  // namespace gelatin
