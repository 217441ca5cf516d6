#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>
#include <tuple>
#include <vector>

#include "cpu/contact/own_rooms.h"
#include "cpu/contact/part_within.h"
#include "cpu/nodes.h"

namespace gelatin::cpu {

/// A node and a face, or two edges, without a node in common: the first side's nodes, then the second's.
struct ContactPair {
    std::array<std::uint32_t, 4> nodes;
    std::array<std::uint32_t, 4> slots;  ///< where each node has what it knows of the pair (ContactAims)
    std::uint32_t first, second;         ///< node and face, or edges
    std::uint32_t object, other;         ///< of the sides
    std::uint32_t first_count;           ///< nodes of the first side: 1, or 2 for edges
    float reach;                         ///< gap at which it begins to press [m]

    bool is_edges() const { return first_count == 2; }
    bool is_own() const { return object == other; }  ///< of one body
    std::size_t side_of(std::size_t k) const { return k < first_count ? 0 : 1; }
    /// Lists are in this order: of the surface nodes, then of the edges, and of what these are near.
    /// @param places of nodes among those of the surface
    std::tuple<bool, std::uint32_t, std::uint32_t> rank(const std::vector<std::uint32_t>& places) const {
        return {is_edges(), is_edges() ? first : places[first], second};
    }
};

/// What a detection has found: all pairs that may come together while each node stays in its room. That is
/// all that is nearer than a radius to the way that it is expected to go from where it was found. Rooms move
/// with their islands. Bodies of an island are near each other. They have motions in common that bring none
/// of them nearer to another. Each collider is an island, too. An island near one has a course: what its
/// bodies have in common is a motion along it, for which pairs with colliders were looked for all the way.
template <class Real>
struct ContactList {
    std::vector<ContactPair> pairs;                    ///< nodes and faces, then edges; each once
    std::size_t first_edges = 0;                       ///< the first pair of edges
    std::vector<std::uint32_t> own_pairs, own_starts;  ///< those of one body, body by body, [objects + 1]
    OwnRooms<Real> own;                                ///< of nodes in their own bodies
    std::vector<std::uint32_t> row_starts;  ///< of the slots of each surface node, shape [surface nodes + 1]
    std::vector<Vec3<Real>> found_at;       ///< [m], shape [surface nodes]
    std::vector<Vec3<Real>> ways;           ///< relative to the island's motion [m], the same shape
    std::vector<Real> rooms;                ///< radius [m], the same shape
    std::vector<std::uint32_t> islands;     ///< of each object
    std::vector<Vec3<Real>> shifts;         ///< of each island since the detection [m]
    std::vector<std::uint8_t> is_alone;     ///< by island: not 0 if it is one body's, and near no collider
    std::vector<std::uint8_t> is_fixed;     ///< by island: not 0 near a collider, and of a collider
    std::vector<Vec3<Real>> drifts;         ///< by island: its course since the detection, 0 if not fixed [m]
    std::vector<Real> drifted;              ///< the part of it that it has gone
    Real most_shift = Real(0);              ///< length that no shift may have [m]
    bool is_valid = false;                  ///< false until something was found

    void clear() { *this = {}; }
    bool is_alone_at(std::size_t object) const { return is_alone[islands[object]] != 0; }
    /// That of its bodies, which are of one; colliders' numbers come after those of bodies.
    std::uint32_t island_of(const ContactPair& pair) const {
        return std::min(islands[pair.object], islands[pair.other]);
    }
    std::size_t slot_count() const { return row_starts.back(); }
    /// From where a surface node of an object was found, moved with its island [m].
    Vec3<Real> moved(std::uint32_t place, std::uint32_t object, const Vec3<Real>& position) const {
        return position - found_at[place] - shifts[islands[object]];
    }
    /// Its distance from its way [m].
    Real beside_way(std::uint32_t place, const Vec3<Real>& moved) const {
        const Vec3<Real>& way = ways[place];
        const Real squared = glm::dot(way, way);
        const Real along =
            squared > Real(0) ? std::clamp(glm::dot(moved, way) / squared, Real(0), Real(1)) : Real(0);
        return glm::length(moved - along * way);
    }
    /// The part of a motion from there that stays in its room.
    Real part_within_room(std::uint32_t place, const Vec3<Real>& moved, const Vec3<Real>& motion) const;
};

// A room is convex: what leaves it does so once.
template <class Real>
Real ContactList<Real>::part_within_room(std::uint32_t place, const Vec3<Real>& moved,
                                         const Vec3<Real>& motion) const {
    const Vec3<Real> end = moved + motion;
    if (glm::dot(end, end) <= rooms[place] * rooms[place]) return Real(1);
    if (ways[place] == Vec3<Real>(0)) return part_within(moved, motion, rooms[place]);
    if (beside_way(place, end) <= rooms[place]) return Real(1);
    if (!(beside_way(place, moved) < rooms[place])) return Real(0);
    constexpr int kHalvings = 10;
    Real low = 0, high = 1;
    for (int i = 0; i < kHalvings; ++i) {
        const Real middle = Real(0.5f) * (low + high);
        (beside_way(place, moved + middle * motion) < rooms[place] ? low : high) = middle;
    }
    return low;
}

}  // namespace gelatin::cpu
