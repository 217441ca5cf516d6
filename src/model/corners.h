#pragma once

#include <array>
#include <cstdint>

#include "model/layouts.h"

namespace gelatin {

inline std::array<std::uint32_t, 3> corners_of(const Face& face) {
    return {face.a, face.b, face.c};
}

/// Whether a node is a corner of a face.
inline bool has_corner(const Face& face, std::uint32_t node) {
    return face.a == node || face.b == node || face.c == node;
}

/// Whether two faces have a corner in common, or are the same.
inline bool share_corner(const Face& f, const Face& g) {
    return has_corner(g, f.a) || has_corner(g, f.b) || has_corner(g, f.c);
}

/// Whether two edges have an end in common, or are the same.
inline bool share_end(const FaceEdge& e, const FaceEdge& f) {
    return e.a == f.a || e.a == f.b || e.b == f.a || e.b == f.b;
}

}  // namespace gelatin
