#pragma once

#include "gpu/support/scenario.h"

namespace gelatin::test {

/// Rows of near pairs, islands and tables where parts of steps begin, and what is solved then, against the
/// double reference and the tables that the host makes.
Scenarios pair_rows_scenarios();

/// Uses all programs of gpu::PairRows once, in the current context.
void run_pair_rows();

}  // namespace gelatin::test
