#pragma once

#include <cstdint>
#include <span>

#include "model/model.h"

namespace gelatin {

/// The faces around each node, in the faces' order.
NodeFaces make_node_faces(std::uint32_t node_count, std::span<const Face> faces);

}  // namespace gelatin
