#include "gpu/implicit/tries.h"

#include <algorithm>
#include <cassert>

#include "gl/group_grid.h"
#include "gpu/implicit/step_buffers.h"
#include "model/shared_constants.h"

namespace gelatin::gpu {
namespace {

namespace slots = try_dispatches;

// Without work groups; `count` has those of a row.
Dispatch waiting(std::size_t groups) {
    const gl::GroupGrid grid(groups);
    return {0, static_cast<std::uint32_t>(grid.rows), 1, static_cast<std::uint32_t>(grid.columns)};
}

void wait_for_try() {
    gl::barrier(gl::Barrier::storage | gl::Barrier::texture_fetch | gl::Barrier::command);
}

}  // namespace

Tries::Tries()
    : clock_(std::vector<StepClock>(1)),
      dispatches_(std::vector<Dispatch>(slots::kTryDispatches, Dispatch{0, 1, 1, 0})),
      follow_clock_(gl::Program::compute("sim/implicit/set_tries.comp")) {
    bind(follow_clock_);
}

void Tries::bind(const gl::Program& program) const {
    program.bind_declared("Clock", clock_);
    program.bind_declared("Dispatches", dispatches_);
}

void Tries::run(Where where, const gl::Program& program, std::size_t groups) {
    run_counted(program, dispatch_of(where, groups));
}

void Tries::run_counted(const gl::Program& program, std::uint32_t dispatch) {
    program.dispatch_indirect(dispatches_.id(), dispatch * sizeof(Dispatch));
    wait_for_try();
}

void Tries::follow_clock() {
    follow_clock_.dispatch_groups(1);
    wait_for_try();
}

// A number of work groups that is asked for the first time gets its own.
std::uint32_t Tries::dispatch_of(Where where, std::size_t groups) {
    const auto known = std::find(sizes_.begin(), sizes_.end(), groups);
    const auto size = static_cast<std::uint32_t>(known - sizes_.begin());
    const std::uint32_t first = slots::kFirstSize + 2 * size;
    if (known == sizes_.end()) {
        assert(size < slots::kMostSizes);
        sizes_.push_back(groups);
        gl::barrier(gl::Barrier::buffer_update);
        dispatches_.upload(std::vector<Dispatch>(2, waiting(groups)), first);
        follow_clock();
    }
    return first + static_cast<std::uint32_t>(where);
}

StepClock Tries::clock() const {
    return read(clock_)[0];
}

void Tries::set_clock(const StepClock& clock) {
    gl::barrier(gl::Barrier::buffer_update);
    clock_.upload(std::vector{clock});
    follow_clock();
}

void Tries::set_count(std::uint32_t dispatch, std::uint32_t count, std::uint32_t lanes) {
    dispatches_.upload(std::vector{Dispatch{(count + lanes - 1) / lanes, 1, 1, count}}, dispatch);
}

}  // namespace gelatin::gpu
