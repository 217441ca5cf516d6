#pragma once

#include "gpu/support/scenario.h"

// Of kernels that advance nodes, and of what is measured and shown of these.
namespace gelatin::test {

/// Explicit steps by all integrators and both ways to sum up forces, of a lively model and of one with moving
/// handles and loads.
Scenarios step_scenarios();

/// Handles before, between and after keyframes, and once one of the two is released.
Scenarios kinematics_scenarios();

/// Loads at several points of their envelopes.
Scenarios load_scenarios();

/// A hand that holds nodes, in explicit steps, beside loads and without.
Scenarios pull_scenarios();

/// Bodies of three sizes that have lost their shapes.
Scenarios matching_scenarios();

/// Neo-Hookean tets: explicit steps, and energies.
Scenarios neo_hookean_step_scenarios();
Scenarios neo_hookean_energy_scenarios();

/// The volume term of springs, below and above a Poisson's ratio of 1/4: explicit steps and energies.
Scenarios volume_step_scenarios();
Scenarios volume_energy_scenarios();

/// Runs that are watched for nodes that are too fast or not finite.
Scenarios watch_scenarios();

/// What colours show of deformed bodies.
Scenarios tet_value_scenarios();

/// Points of skins at the origin and far from it.
Scenarios carry_skin_scenarios();

}  // namespace gelatin::test
