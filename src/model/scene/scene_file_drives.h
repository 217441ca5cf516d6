#pragma once

#include "gelatin/scene.h"
#include "model/scene/scene_file_reader.h"

namespace gelatin {

/// An [[object.handle]] table, which it finishes.
HandleDescription read_handle(TableReader reader);

/// An [[object.load]] table, which it finishes.
LoadDescription read_load(TableReader reader);

}  // namespace gelatin
