#pragma once

#include <cstddef>
#include <span>

#include "cpu/nodes.h"
#include "model/model.h"

namespace gelatin::test {

/// Pairs of faces of different bodies, and of bodies and colliders, that share a point, in exact arithmetic
/// (tests/exact) and independent of what the solvers use to find them.
std::size_t count_overlaps(const Model& model, std::span<const cpu::Vec4<double>> positions);
std::size_t count_overlaps(const Model& model, std::span<const cpu::Vec4<float>> positions);

}  // namespace gelatin::test
