#pragma once

#include <vector>

#include "model/model.h"

namespace gelatin::gpu {

/// Runs of up to 256 nodes or faces (`range` says which) of one object each, in the objects' order: what a
/// work group sums up.
std::vector<Chunk> make_chunks(const Model& model, Range ModelObject::*range);

}  // namespace gelatin::gpu
