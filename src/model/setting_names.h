#pragma once

#include "gelatin/scene.h"

namespace gelatin {

/// The names of settings in scene files.
const char* name_of(SolverKind solver);
const char* name_of(ForceMethod forces);
const char* name_of(BroadPhase broad_phase);
const char* name_of(CollisionDetection detection);
const char* name_of(CollisionResponse response);

}  // namespace gelatin
