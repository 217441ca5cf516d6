#include "bench/windows.h"

#include <fmt/core.h>

#include <algorithm>
#include <cstdint>
#include <set>

namespace gelatin {
namespace {

Simulator make_fastest(const Scene& scene) {
    SimulatorOptions options;
    options.use_current_context = true;
    return Simulator(scene, options);
}

}  // namespace

std::vector<int> window_starts(int frames, int count, int length) {
    length = std::min(length, frames);
    if (length < 1) return {};
    count = std::clamp(count, 1, frames / length);
    std::vector<int> starts;
    for (std::int64_t w = 0; w < count; ++w) {
        const std::int64_t middle = (2 * w + 1) * frames / (2 * count);
        starts.push_back(static_cast<int>(middle) - length / 2);
    }
    return starts;
}

BenchWindows::BenchWindows(const Scene& scene, int frames, int windows, int window_frames,
                           const std::filesystem::path& folder)
    : frames_(frames),
      windows_(windows),
      window_frames_(window_frames),
      contact_free_frames_(count_contact_free_frames(scene)),
      folder_(folder) {
    save_states(scene);
}

int BenchWindows::count_contact_free_frames(const Scene& scene) const {
    Simulator simulator = make_fastest(scene);
    while (simulator.frame() < frames_) {
        simulator.advance_frame();
        simulator.begin_statistics();
        if (simulator.take_statistics().colliding_faces > 0) return simulator.frame() - 1;
    }
    return frames_;
}

std::vector<BenchWindow> BenchWindows::sample(BenchPart part) const {
    std::vector<BenchWindow> windows;
    const int length = std::min(window_frames_, frames(part));
    for (const int start : window_starts(frames(part), windows_, window_frames_))
        windows.push_back({state_file(start), length});
    return windows;
}

void BenchWindows::save_states(const Scene& scene) const {
    std::set<int> wanted{0};
    for (const BenchPart part : {BenchPart::whole_run, BenchPart::until_contact})
        for (const int start : window_starts(frames(part), windows_, window_frames_)) wanted.insert(start);
    Simulator simulator = make_fastest(scene);
    for (const int frame : wanted) {
        while (simulator.frame() < frame) simulator.advance_frame();
        simulator.save_checkpoint(state_file(frame));
    }
}

std::filesystem::path BenchWindows::state_file(int frame) const {
    return folder_ / fmt::format("frame_{:06}.state", frame);
}

}  // namespace gelatin
