#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "mesh/surface_mesh.h"

namespace gelatin {

/// One side of a face, as a use of its edge.
struct EdgeUse {
    std::uint32_t low, high;  ///< the edge's vertices, low <= high
    std::uint32_t face;
    bool ascending;  ///< the face traverses it from low to high
};

/// Three uses for each face, sorted so that those of one edge are contiguous, in the order of the faces.
std::vector<EdgeUse> sorted_edge_uses(std::span<const glm::uvec3> faces);

/// Calls visit(std::span<const EdgeUse>) once for each edge.
template <class Visit>
void for_each_edge(std::span<const EdgeUse> uses, Visit visit) {
    for (std::size_t begin = 0, end = 0; begin < uses.size(); begin = end) {
        while (end < uses.size() && uses[end].low == uses[begin].low && uses[end].high == uses[begin].high)
            ++end;
        visit(uses.subspan(begin, end - begin));
    }
}

}  // namespace gelatin
