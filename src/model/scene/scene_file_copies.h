#pragma once

#include <vector>

#include "gelatin/scene.h"
#include "model/scene/scene_file_reader.h"

namespace gelatin {

/// The objects that an object's `copies` table asks for: "NAME 1", "NAME 2" and so on, layer by layer from
/// below. The same each time, jitter included.
/// @param reader the table, which it finishes
std::vector<ObjectDescription> read_copies(TableReader reader, const ObjectDescription& original);

}  // namespace gelatin
