#pragma once

#include "gelatin/scene.h"
#include "model/scene/scene_file_reader.h"

namespace gelatin {

/// An [[object.cavity]] table, which it finishes.
CavityDescription read_cavity(TableReader reader);

}  // namespace gelatin
