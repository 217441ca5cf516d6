#pragma once

#include <cstdint>

#include "gpu/support/scenario.h"

namespace gelatin::test {

/// Forces, products and diagonals of the elements of a step against the double reference.
Scenarios elastic_system_scenarios();

/// Solved systems against the double reference: after some iterations, and to where no body lacks more than
/// it may; how many that takes.
/// @param small_chunks as in gpu::StepSystem; which path solves islands
Scenarios step_system_scenarios(std::uint32_t small_chunks = 0);
/// Those of islands of up to packing::kChunksOfSmallIsland, which a work group solves.
Scenarios small_island_scenarios(bool with_rows);

/// Whether a system is solved to the same bits again.
bool solves_repeat();

/// Uses all programs of the implicit step once, in the current context.
void run_implicit_programs();

}  // namespace gelatin::test
