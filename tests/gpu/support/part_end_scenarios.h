#pragma once

#include "gpu/support/scenario.h"

namespace gelatin::test {

/// Parts of implicit steps, one after the other, whose ends are made on the device and by the double
/// reference of the same displacements: nodes, energies, what is owed, impacts, and what is decided.
Scenarios part_end_scenarios();

/// Whether a part ends with the same bits again.
bool ends_repeat();

/// Uses all programs of the end of a part once, in the current context.
void run_end_programs();

}  // namespace gelatin::test
