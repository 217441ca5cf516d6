#pragma once

#include "gelatin/scene.h"
#include "model/scene/scene_file_reader.h"

namespace gelatin {

/// A part of space: { box = ... }, { sphere = ... } or { plane = ... }.
/// @param reader the table, which it finishes
Region read_region(TableReader reader);

}  // namespace gelatin
