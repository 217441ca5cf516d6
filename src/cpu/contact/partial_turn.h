#pragma once

#include <cstdint>
#include <span>

#include "cpu/nodes.h"
#include "model/model.h"

namespace gelatin::cpu {

/// Where a body is to make a part of a motion that turns it. Nodes go straight, so that it would get smaller
/// on the way: of a stiff body that takes more energy than it has. Changes the ends so that it keeps its
/// shape where it has made that part.
/// @param part of its way to `ends`, in (0, 1) @param ends of a rigid motion, input and output
/// @return false if it would hardly get smaller; then they stay
template <class Real>
bool turn_in_part(const Model& model, std::uint32_t object, double part,
                  std::span<const Vec4<Real>> positions, std::span<Vec4<Real>> ends);

}  // namespace gelatin::cpu
