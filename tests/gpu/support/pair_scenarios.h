#pragma once

#include "gpu/support/scenario.h"

namespace gelatin::test {

/// gpu::FindPairs against cpu::FindPairs<double>, of the same paths.
Scenarios pair_scenarios();

/// Whether two runs find the same bits.
bool pairs_repeat();

/// Uses all programs of gpu::FindPairs once, in the current context.
void run_find_pairs();

}  // namespace gelatin::test
