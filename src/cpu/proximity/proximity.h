#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "cpu/collision/nearest_points.h"
#include "model/model.h"

namespace gelatin::cpu {

/// A node and a face, or two edges, nearer than the radius; gelatin::Proximity in the precision of a backend.
template <class Real>
struct Proximity {
    std::uint32_t first;   ///< node, or index into SurfaceParts::edges
    std::uint32_t second;  ///< face, or index into SurfaceParts::edges
    Real distance;         ///< [m], >= 0
    Vec3<Real> apart;      ///< from the first one's nearest point to the second's [m]
    Vec4<Real> weights;    ///< node and face: weights of the face's corners, 0; edges: 1 - s, s, 1 - t, t of
                           ///< their ends

    bool operator==(const Proximity&) const = default;
};

/// The nearest points of the two [m], first and second. They are computed relative to corners, so that they
/// are accurate far from the origin too: weights add up to 1 only up to rounding.
template <class Real>
using NearestPoints = std::array<Vec3<Real>, 2>;

template <class Real>
NearestPoints<Real> nearest_points_of_node_and_face(const Model& model, std::span<const Vec4<Real>> positions,
                                                    const Proximity<Real>& proximity) {
    const Face& face = model.faces[proximity.second];
    const Vec3<Real> a(positions[face.a]), b(positions[face.b]), c(positions[face.c]);
    const Vec4<Real>& w = proximity.weights;
    return {Vec3<Real>(positions[proximity.first]), a + w.y * (b - a) + w.z * (c - a)};
}

template <class Real>
NearestPoints<Real> nearest_points_of_edges(const Model& model, std::span<const Vec4<Real>> positions,
                                            const Proximity<Real>& proximity) {
    const FaceEdge &edge = model.surface_parts.edges[proximity.first],
                   &other = model.surface_parts.edges[proximity.second];
    const Vec3<Real> a(positions[edge.a]), b(positions[edge.b]), c(positions[other.a]), d(positions[other.b]);
    return {a + proximity.weights.y * (b - a), c + proximity.weights.w * (d - c)};
}

}  // namespace gelatin::cpu
