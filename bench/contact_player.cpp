#include "bench/contact_player.h"

#include <algorithm>
#include <chrono>
#include <numeric>
#include <utility>

#include "bench/samples.h"
#include "bench/threads.h"
#include "cpu/implicit/system_solver.h"
#include "gl/program.h"
#include "gpu/implicit/implicit_solver.h"

namespace gelatin {
namespace {

const std::string kPartOf = "advance_nodes.";

// Whoever reads nodes completes a step; here nobody does.
struct DeviceSteps final : gpu::ImplicitSolver {
    using ImplicitSolver::complete, ImplicitSolver::ImplicitSolver;
};

}  // namespace

double ContactSample::mean() const {
    return std::accumulate(frames.begin(), frames.end(), 0.0) / static_cast<double>(frames.size());
}

double ContactSample::median() const {
    return summarise(frames).median;
}

double ContactSample::worst() const {
    return *std::max_element(frames.begin(), frames.end());
}

ContactPlayer::Steps ContactPlayer::make_steps(const ContactCase& contact_case, bool uses_gl) {
    const ContactCase& of = contact_case;
    if (uses_gl) {
        // By default scenes of a thousand bodies have room for more than a storage block of llvmpipe holds.
        gpu::PairCapacity room = gpu::PairCapacity::of(*of.model);
        room.pairs /= 4;
        auto device = std::make_unique<DeviceSteps>(of.model, of.collision, of.implicit, room);
        DeviceSteps& steps = *device;
        const auto finish = [&steps] {
            steps.complete();
            gl::finish();
        };
        return {std::move(device), finish, [] { return 0.0; }};
    }
    auto host = std::make_unique<cpu::SystemSolver<float>>(of.model, of.collision, of.implicit);
    const cpu::SystemSolver<float>& steps = *host;
    return {std::move(host), [] {},
            [&steps] { return static_cast<double>(steps.solve_counts().multiplied_nodes); }};
}

ContactPlayer::ContactPlayer(const ContactCase& contact_case, const StageSystem& system, int frames)
    : system_(system),
      start_(contact_case.start),
      frame_time_(contact_case.frame_time),
      frames_(frames),
      steps_(make_steps(contact_case, system.uses_gl)) {
    steps_.solver->stage_timer().time_parts(true);
}

void ContactPlayer::make_frame() {
    steps_.solver->advance({frame_time_});
    steps_.finish();
}

void ContactPlayer::begin() {
    steps_.solver->write_state(start_);
    for (int f = 0; f < kContactWarmUp; ++f) make_frame();
}

ContactSample ContactPlayer::sample() {
    const ThreadLimit limit(system_.threads);
    begin();
    StageTimer& timer = steps_.solver->stage_timer();
    timer.take();
    ContactSample sample;
    const double multiplied_before = steps_.multiplied_nodes();
    for (int f = 0; f < frames_; ++f) {
        const auto start = std::chrono::steady_clock::now();
        make_frame();
        const std::chrono::duration<double, std::milli> elapsed = std::chrono::steady_clock::now() - start;
        sample.frames.push_back(elapsed.count());
        for (const ContactForces::Between& between : steps_.solver->contact_forces().between)
            sample.contacts += static_cast<double>(between.points) / frames_;
    }
    for (const auto& [stage, times] : timer.take()) {
        sample.stages[stage.substr(kPartOf.size())] =
            std::accumulate(times.begin(), times.end(), 0.0) / frames_;
        if (stage == kPartOf + "solve") sample.tries = static_cast<double>(times.size()) / frames_;
    }
    sample.multiplied_nodes = (steps_.multiplied_nodes() - multiplied_before) / frames_;
    return sample;
}

gl::DispatchCounter::Counts ContactPlayer::count_dispatches() {
    begin();
    gl::DispatchCounter counter;
    for (int f = 0; f < frames_; ++f) make_frame();
    return counter.take();
}

}  // namespace gelatin
