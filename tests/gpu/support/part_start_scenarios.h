#pragma once

#include "gpu/support/scenario.h"

namespace gelatin::test {

/// Where parts of a step begin, with the tries that are given up before, and what is solved then: against
/// the double reference.
Scenarios part_start_scenarios();

/// Uses all programs of gpu::PartStart once, in the current context.
void run_part_start();

}  // namespace gelatin::test
