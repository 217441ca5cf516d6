#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "cpu/nodes.h"

namespace gelatin::cpu {

/// A node and a face, or two edges, of different bodies: the first side's nodes, then the second's.
struct ContactPair {
    std::array<std::uint32_t, 4> nodes;
    std::array<std::uint32_t, 4> slots;  ///< where each node has what it knows of the pair (ContactAims)
    std::uint32_t first, second;         ///< as Proximity has them
    std::uint32_t object, other;         ///< of the sides
    std::uint32_t first_count;           ///< nodes of the first side: 1, or 2 for edges

    bool is_edges() const { return first_count == 2; }
    std::size_t side_of(std::size_t k) const { return k < first_count ? 0 : 1; }
};

/// What a detection has found: all pairs that may come together while each node stays in its room, a ball
/// round where it was found that moves with its island. Bodies of an island are near each other. They have
/// motions in common that bring none of them nearer to another.
template <class Real>
struct ContactList {
    std::vector<ContactPair> pairs;         ///< nodes and faces, then edges; each once
    std::size_t first_edges = 0;            ///< the first pair of edges
    std::vector<std::uint32_t> row_starts;  ///< of the slots of each surface node, shape [surface nodes + 1]
    std::vector<std::uint32_t> slot_pairs;  ///< 4 times the pair, plus the node's index in it
    std::vector<Vec3<Real>> found_at;       ///< [m], shape [surface nodes]
    std::vector<Real> rooms;                ///< radius [m], the same shape
    std::vector<std::uint32_t> islands;     ///< of each object
    std::vector<Vec3<Real>> shifts;         ///< of each island since the detection [m]
    std::vector<std::uint8_t> is_alone;     ///< by island: not 0 if it is one body's
    Real most_shift = Real(0);              ///< length that no shift may have [m]
    bool is_valid = false;                  ///< false until something was found

    void clear() { *this = {}; }
    bool is_alone_at(std::size_t object) const { return is_alone[islands[object]] != 0; }
    bool has_pairs(std::uint32_t place) const { return row_starts[place + 1] > row_starts[place]; }
};

}  // namespace gelatin::cpu
