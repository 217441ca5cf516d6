#pragma once

#include "gpu/support/scenario.h"

// Of kernels that know contacts.
namespace gelatin::test {

/// Sweeps with contacts, of bodies that rest on each other, slide, and are thrown farther than they may go.
Scenarios limited_sweep_scenarios();

}  // namespace gelatin::test
