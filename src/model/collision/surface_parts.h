#pragma once

#include <cstdint>
#include <span>

#include "model/model.h"

namespace gelatin {

/// @param around the same faces by node
SurfaceParts make_surface_parts(std::span<const Face> faces, const NodeFaces& around);

/// Of an object's faces, the nodes: a range of parts.nodes.
inline Range surface_places(const SurfaceParts& parts, const Range& faces) {
    const std::uint32_t first = parts.face_starts[faces.first].x;
    return {first, parts.face_starts[faces.end()].x - first};
}

}  // namespace gelatin
