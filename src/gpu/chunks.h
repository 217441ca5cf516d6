#pragma once

#include <vector>

#include "model/model.h"

namespace gelatin::gpu {

/// Ranges of up to 256 nodes or faces (selected by `range`) of one object each, in the objects' order: what
/// one work group sums.
std::vector<Chunk> make_chunks(const Model& model, Range ModelObject::*range);

/// The first of each object's chunks, and the end, shape [objects + 1].
std::vector<std::uint32_t> chunk_starts(const std::vector<Chunk>& chunks, std::size_t object_count);

}  // namespace gelatin::gpu
