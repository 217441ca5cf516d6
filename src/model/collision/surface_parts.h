#pragma once

#include <cstdint>
#include <span>

#include "model/model.h"

namespace gelatin {

/// @param around the same faces by node
SurfaceParts make_surface_parts(std::span<const Face> faces, const NodeFaces& around);

}  // namespace gelatin
