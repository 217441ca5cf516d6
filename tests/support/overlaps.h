#pragma once

#include <cstddef>
#include <span>

#include "cpu/nodes.h"
#include "model/drive/attachment.h"
#include "model/model.h"

namespace gelatin::test {

/// Which faces count that share a point.
enum class Overlaps {
    all,      ///< of one body, too, if they have no corner in common, or an edge of one without it passes
              ///< through the other
    between,  ///< of different bodies, or of a body and a collider
};

/// Pairs of faces, but for those of rigid bodies that are joined, in exact arithmetic (tests/exact) and
/// independent of what the solvers use to find them.
std::size_t count_overlaps(const Model& model, std::span<const cpu::Vec4<double>> positions,
                           Overlaps which = Overlaps::all, const JoinedBodies& joined = {});
std::size_t count_overlaps(const Model& model, std::span<const cpu::Vec4<float>> positions,
                           Overlaps which = Overlaps::all, const JoinedBodies& joined = {});

}  // namespace gelatin::test
