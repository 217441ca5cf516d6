#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <ostream>
#include <string>

#include "gelatin/error.h"
#include "mesh/surface_mesh.h"

namespace gelatin {

/// Axis-parallel cube from `corner`, 12 faces wound outwards. Vertex x + 2 y + 4 z is the corner at (x, y,
/// z).
inline SurfaceMesh cube(const glm::dvec3& corner, double size) {
    SurfaceMesh mesh;
    for (int v = 0; v < 8; ++v)
        mesh.positions.push_back(corner + size * glm::dvec3(v & 1, v >> 1 & 1, v >> 2));
    mesh.faces = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                  {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
    return mesh;
}

/// For GoogleTest's messages.
inline void PrintTo(const Note& note, std::ostream* out) {
    *out << (note.is_warning ? "warning: " : "note: ") << note.text;
}

inline void append(SurfaceMesh& mesh, const SurfaceMesh& other) {
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    mesh.positions.insert(mesh.positions.end(), other.positions.begin(), other.positions.end());
    for (const glm::uvec3& face : other.faces) mesh.faces.push_back(face + first);
}

/// The message of the InvalidInput that `call` throws; anything else fails the test.
template <class Call>
std::string refusal(Call call) {
    try {
        call();
    } catch (const InvalidInput& error) {
        return error.what();
    }
    ADD_FAILURE() << "was not refused";
    return {};
}

}  // namespace gelatin
