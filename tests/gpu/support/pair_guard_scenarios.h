#pragma once

#include "gpu/support/scenario.h"

namespace gelatin::test {

/// The guard of pairs and planes against the double reference, and whether surfaces keep apart.
Scenarios pair_guard_scenarios();

/// Uses all programs of the guard of pairs once, in the current context.
void run_pair_guard();

}  // namespace gelatin::test
