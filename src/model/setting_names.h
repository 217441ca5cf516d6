#pragma once

#include <string>
#include <vector>

#include "gelatin/scene.h"

namespace gelatin {

/// The names of settings in scene files.
const char* name_of(SolverKind solver);
const char* name_of(ForceMethod forces);
const char* name_of(BroadPhase broad_phase);
const char* name_of(CollisionDetection detection);
const char* name_of(CollisionResponse response);
const char* name_of(Axis axis);

/// The tables of scene files that such objects are in: "object" or "rigid".
const char* table_name(const ObjectDescription& object);

const std::vector<std::string>& spring_kind_names();
std::vector<std::string> kind_names(const SpringKinds& kinds);

}  // namespace gelatin
