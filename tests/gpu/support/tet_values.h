#pragma once

#include <cstdint>
#include <glm/vec4.hpp>
#include <vector>

#include "gelatin/views.h"
#include "model/model.h"

namespace gelatin::test {

/// Bodies whose nodes are elsewhere than at rest.
struct Deformed {
    Model model;
    std::vector<glm::vec4> positions, velocities;
};

/// Blocks of different materials, of springs and neo-Hookean, bent and set in motion, some tets inside out,
/// some flat, some in a point; the last one drawn out to a line. No multiple of 64 tets or nodes.
Deformed make_deformed();

/// The values that colours show, without bounds: the reference in double precision, by singular value
/// decomposition.
struct Values {
    std::vector<double> tets, nodes;
};
Values expected_values(const Deformed& bodies, Quantity quantity);

/// The same as the GPU finds them, what it writes being poisoned before.
struct GpuValues {
    std::vector<float> tets, nodes;
    std::vector<std::uint32_t> histogram;
};
GpuValues values_on_gpu(const Deformed& bodies, Quantity quantity);

/// The largest error over what single precision may do; infinite where something is not finite, or where the
/// histogram is not that of the tets. At most 1 is a pass. To first order F is off by 16 eps |Ds| |Dm^-1|
/// cond Dm, the largest stretch as much as F, and each smaller one l by 16 eps |F|^2 / l more, but no more
/// than the root of 16 eps, times |F|: it is the root of an eigenvalue.
double worst_value_error(const Deformed& bodies, Quantity quantity, const GpuValues& actual);

}  // namespace gelatin::test
