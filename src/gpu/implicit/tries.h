#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "gl/buffer.h"
#include "gl/program.h"
#include "model/layouts.h"

namespace gelatin::gpu {

/// The tries to make a part of a step, as the device runs them. The host launches all dispatches of a try;
/// those that do not apply have no work groups. Kernels that set the clock see to that
/// (sim/implicit/tries.glsl), those that count the elements of a list to the dispatches for these.
class Tries {
public:
    /// Where a dispatch applies: if the try makes a part, or also if it goes on with the guard alone.
    enum class Where : std::uint32_t { makes_part, goes_on };

    Tries();

    /// Blocks Clock and Dispatches, if the program has them.
    void bind(const gl::Program& program) const;
    /// Ends with the barrier for whoever reads what it writes, as storage, texels or arguments.
    void run(Where where, const gl::Program& program, std::size_t groups);
    /// The same for a number of work groups that the device finds. @param dispatch of try_dispatches or
    /// pair_stages
    void run_counted(const gl::Program& program, std::uint32_t dispatch);
    /// Makes the arguments those for the clock as it is on the device.
    void follow_clock();

    /// Blocks until the device has ended its tries.
    StepClock clock() const;
    void set_clock(const StepClock& clock);
    /// For what else reads it.
    const gl::Buffer<StepClock>& clock_buffer() const { return clock_; }
    /// For tests: as the device counts the elements of a list. @param lanes of a work group
    void set_count(std::uint32_t dispatch, std::uint32_t count, std::uint32_t lanes = 64);

private:
    std::uint32_t dispatch_of(Where where, std::size_t groups);

    gl::Buffer<StepClock> clock_;      // one
    gl::Buffer<Dispatch> dispatches_;  // try_dispatches
    std::vector<std::size_t> sizes_;   // numbers of work groups so far
    gl::Program follow_clock_;
};

}  // namespace gelatin::gpu
