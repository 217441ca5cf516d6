#pragma once

#include "gpu/support/scenario.h"

// Of kernels that find what collides or is near, and that respond to it.
namespace gelatin::test {

/// Crowds of 2 to 200 objects, by every broad phase.
Scenarios collision_scenarios();

/// The same with continuous detection, by every broad phase that has it.
Scenarios continuous_collision_scenarios();

/// Pairs of cubes strewn so far that each is from a hundredth of a pixel of the views of broad_phase =
/// "depth" to some pixels large: often no centre of a pixel lies in a face, or in what touches.
Scenarios far_pair_scenarios();

/// Responses in crowds, with friction and restitution, with moving handles, and by continuous detection.
Scenarios response_scenarios();

/// What bodies touch of themselves, however deformed, and whatever they were before.
Scenarios self_collision_scenarios();

/// How many faces are tested in bodies that are hardly deformed: what is needless costs.
Scenarios calm_scenarios();

/// Responses to what bodies touch of themselves.
Scenarios self_response_scenarios();

/// What is nearer than a radius in each of kProximityScenes.
Scenarios proximity_scenarios();

/// Marks of faces that touch others, or their own object.
Scenarios mark_scenarios();

}  // namespace gelatin::test
