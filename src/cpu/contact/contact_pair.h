#pragma once

#include <array>
#include <cstdint>

namespace gelatin::cpu {

/// A node and a face, or two edges, without a node in common: the first side's nodes, then the second's.
struct ContactPair {
    std::array<std::uint32_t, 4> nodes;
    std::uint32_t first, second;  ///< node and face, or edges
    std::uint32_t object, other;  ///< of the sides
    std::uint32_t first_count;    ///< nodes of the first side: 1, or 2 for edges
    float reach;                  ///< gap at which it begins to press [m]

    bool is_edges() const { return first_count == 2; }
    bool is_own() const { return object == other; }  ///< of one body
    std::size_t side_of(std::size_t k) const { return k < first_count ? 0 : 1; }
};

}  // namespace gelatin::cpu
