#pragma once

#include <span>
#include <vector>

#include "cpu/descent/island_system.h"

namespace gelatin::cpu {

/// The part of a way that each body of an island makes, so that the objective is least: contacts and friction
/// as they are, the rest to second order. Bodies that press each other on the way make the same part. What
/// meets them only once they have stopped makes a part of its own.
/// @param motions so far, which contacts know already; shape of these and of the way: [bodies]
std::vector<double> least_parts(const IslandSystem& island, std::span<const Motion> motions,
                                const std::vector<Motion>& way);

}  // namespace gelatin::cpu
