#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "gpu/implicit/pair_buffers.h"
#include "gpu/implicit/pair_rows.h"
#include "gpu/implicit/part_start.h"
#include "gpu/support/part_start_reference.h"
#include "model/contact/contact_surface.h"

namespace gelatin::test {

template <class T>
std::vector<T> downloaded(const gl::Buffer<T>& buffer) {
    std::vector<T> values(buffer.size());
    gl::barrier(gl::Barrier::buffer_update);
    buffer.download(values);
    return values;
}

/// A part that begins on the device: tries until one goes on, or many were made.
class StartOnGpu {
public:
    /// @param near of the tries of the reference, which take their turns
    StartOnGpu(const StartCase& at, const StartInputs& inputs, std::vector<NearPairs> near = {});

    StepClock read_clock() const { return state.tries.clock(); }
    /// @return whether what is given up has left all as it was
    bool run();
    /// Solves, too.
    StartResult result();
    /// Of the tables, as many as there are, with both objects.
    std::vector<cpu::ContactRow<double>> rows() const;

    gpu::ModelBuffers buffers;
    ContactSurface surface;
    gpu::StepState state;
    gpu::StepSystem system;
    std::optional<gpu::PairBuffers> pairs;
    std::optional<gpu::PairRows> pair_rows;
    gpu::PartStart start;

private:
    void upload(const NearPairs& near);

    const StartCase& case_;
    const Model& model_;
    std::vector<NearPairs> near_;
    std::optional<gpu::SumLoads> loads_;
};

/// Where a part begins and what is solved then, against the reference.
double start_error(const StartCase& at);

/// What two rows of the same contact have in common, and others have not.
std::vector<std::uint32_t> key_of(const cpu::ContactRow<double>& row);

}  // namespace gelatin::test
