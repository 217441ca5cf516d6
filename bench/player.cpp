#include "bench/player.h"

#include <fmt/core.h>

#include <chrono>

#include "bench/threads.h"
#include "gl/fence.h"
#include "gl/program.h"

namespace gelatin {
namespace {

constexpr PictureSize kPicture{1280, 720};
constexpr auto kQuality = render::Quality::fast;  // lit at the nodes, as in the paper

SimulatorOptions options_of(const BenchSystem& system) {
    SimulatorOptions options;
    options.backend = system.backend;
    options.use_current_context = true;
    return options;
}

}  // namespace

std::string describe_bench_picture() {
    return fmt::format("{}x{}, {}", kPicture.width, kPicture.height,
                       kQuality == render::Quality::fast ? "fast" : "high");
}

BenchPlayer::BenchPlayer(const Scene& scene, const BenchSystem& system)
    : threads_(system.threads),
      simulator_(system.configure(scene), options_of(system)),
      painter_(simulator_, kPicture, kQuality),
      pipeline_(simulator_) {}

double BenchPlayer::time_window(const BenchWindow& window, bool drawn) {
    const ThreadLimit limit(threads_);
    simulator_.load_checkpoint(window.start);
    gl::finish();
    const auto start = std::chrono::steady_clock::now();
    play(window.frames, drawn);
    gl::finish();
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

void BenchPlayer::play(int frames, bool drawn) {
    gl::Fence last_frame;
    for (int f = 0; f < frames; ++f) {
        if (drawn) {
            const RenderView bodies = simulator_.render_view();
            pipeline_.advance_beside([&] { painter_.draw(bodies); });
        } else {
            simulator_.advance_frame();
            if (!simulator_.uses_gl()) continue;
        }
        // One frame may be pending while the next is submitted; a long queue would show the user old
        // pictures.
        gl::Fence this_frame = gl::Fence::insert();
        last_frame.wait();
        last_frame = std::move(this_frame);
    }
}

}  // namespace gelatin
