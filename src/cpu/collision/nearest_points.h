#pragma once

#include <algorithm>
#include <array>
#include <glm/geometric.hpp>
#include <limits>

#include "cpu/nodes.h"
#include "model/shared_constants.h"

namespace gelatin::cpu {

/// The nearest points of two faces, edges or nodes. `apart` points from the first one's nearest point to the
/// second's. Its direction is accurate to rounding however short it is, because it is computed from normals
/// and from residuals along edges, not as the difference of two points. Edges and faces may be degenerate:
/// then they are the points or segments that they cover. GLSL twin:
/// shaders/sim/collision/nearest_points.glsl.

template <class Real>
struct NodeToEdge {
    Real fraction;          ///< fraction of the edge from its first end, in [0, 1]
    Vec3<Real> apart;       ///< from the node to the edge [m]
    Real squared_distance;  ///< [m^2]
};

template <class Real>
struct NodeToFace {
    Vec3<Real> weights;     ///< barycentric, for the face's corners; from 0 to 1 each, with sum 1
    Vec3<Real> apart;       ///< from the node to the face [m]
    Real squared_distance;  ///< [m^2]
};

template <class Real>
struct EdgeToEdge {
    Real fraction, other_fraction;  ///< fraction of each edge from its first end, in [0, 1]
    Vec3<Real> apart;               ///< from the first edge to the second [m]
    Real squared_distance;          ///< [m^2]
};

/// Two directions u, v with |u x v|^2 <= this u^2 v^2 count as parallel. Then rounding rotates their common
/// normal by as much as assuming that they are parallel would.
template <class Real>
constexpr Real kParallel = predicates::kParallelRounding* std::numeric_limits<Real>::epsilon();

template <class Real>
NodeToEdge<Real> nearest_points(const Vec3<Real>& p, const Vec3<Real>& a, const Vec3<Real>& b) {
    const Vec3<Real> edge = b - a, to_edge = a - p;
    const Real squared_length = glm::dot(edge, edge);
    const Real along = squared_length > Real(0) ? -glm::dot(to_edge, edge) / squared_length : Real(0);
    const Real fraction = std::clamp(along, Real(0), Real(1));
    Vec3<Real> apart = to_edge + fraction * edge;
    // The rounding error along the edge would rotate a short vector by a large angle.
    if (along > Real(0) && along < Real(1)) apart -= glm::dot(apart, edge) / squared_length * edge;
    return {fraction, apart, glm::dot(apart, apart)};
}

template <class Real>
NodeToFace<Real> nearest_points(const Vec3<Real>& p, const std::array<Vec3<Real>, 3>& face) {
    const Vec3<Real> u = face[1] - face[0], v = face[2] - face[0], w = p - face[0];
    const Vec3<Real> normal = glm::cross(u, v);
    const Real size = glm::dot(normal, normal);
    const Real second = glm::dot(glm::cross(w, v), normal), third = glm::dot(glm::cross(u, w), normal);
    if (size > kParallel<Real> * glm::dot(u, u) * glm::dot(v, v) && second >= Real(0) && third >= Real(0) &&
        second + third <= size) {
        const Vec3<Real> apart = -(glm::dot(w, normal) / size) * normal;
        return {Vec3<Real>(size - second - third, second, third) / size, apart, glm::dot(apart, apart)};
    }
    NodeToFace<Real> nearest{{}, {}, std::numeric_limits<Real>::infinity()};
    for (int k = 0; k < 3; ++k) {
        const int next = (k + 1) % 3;
        const NodeToEdge<Real> edge = nearest_points(p, face[k], face[next]);
        if (!(edge.squared_distance < nearest.squared_distance)) continue;
        nearest = {Vec3<Real>(0), edge.apart, edge.squared_distance};
        nearest.weights[k] = Real(1) - edge.fraction;
        nearest.weights[next] = edge.fraction;
    }
    return nearest;
}

/// The nearest points of two edges' lines, if they are within the edges; otherwise, and if the edges are
/// parallel, at an infinite distance: then an end is nearest.
template <class Real>
EdgeToEdge<Real> nearest_inner_points(const std::array<Vec3<Real>, 2>& edge,
                                      const std::array<Vec3<Real>, 2>& other) {
    const Vec3<Real> u = edge[1] - edge[0], v = other[1] - other[0], w = other[0] - edge[0];
    const Vec3<Real> normal = glm::cross(u, v);
    const Real size = glm::dot(normal, normal);
    const Real first = glm::dot(glm::cross(w, v), normal), second = glm::dot(glm::cross(w, u), normal);
    if (!(size > kParallel<Real> * glm::dot(u, u) * glm::dot(v, v)) || first < Real(0) || first > size ||
        second < Real(0) || second > size) {
        return {Real(0), Real(0), Vec3<Real>(0), std::numeric_limits<Real>::infinity()};
    }
    const Vec3<Real> apart = glm::dot(w, normal) / size * normal;
    return {first / size, second / size, apart, glm::dot(apart, apart)};
}

template <class Real>
EdgeToEdge<Real> nearest_points(const std::array<Vec3<Real>, 2>& edge,
                                const std::array<Vec3<Real>, 2>& other) {
    EdgeToEdge<Real> nearest = nearest_inner_points(edge, other);
    for (int k = 0; k < 2; ++k) {
        const NodeToEdge<Real> from = nearest_points(edge[k], other[0], other[1]);
        if (from.squared_distance < nearest.squared_distance)
            nearest = {Real(k), from.fraction, from.apart, from.squared_distance};
        const NodeToEdge<Real> to = nearest_points(other[k], edge[0], edge[1]);
        if (to.squared_distance < nearest.squared_distance)
            nearest = {to.fraction, Real(k), -to.apart, to.squared_distance};
    }
    return nearest;
}

/// The vector between the nearest points of two faces [m]: from a corner to the other face, or between two
/// edges. If they do not touch, a plane perpendicular to it separates the faces.
template <class Real>
Vec3<Real> shortest_between(const std::array<Vec3<Real>, 3>& face, const std::array<Vec3<Real>, 3>& other) {
    Vec3<Real> shortest(0);
    Real least = std::numeric_limits<Real>::infinity();
    const auto take = [&](const Vec3<Real>& apart, Real squared_distance) {
        if (!(squared_distance < least)) return;
        shortest = apart;
        least = squared_distance;
    };
    for (int k = 0; k < 3; ++k) {
        const NodeToFace<Real> from = nearest_points(face[k], other), to = nearest_points(other[k], face);
        take(from.apart, from.squared_distance);
        take(-to.apart, to.squared_distance);
    }
    for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 3; ++j) {  // ends have been compared above
            const EdgeToEdge<Real> edges =
                nearest_inner_points<Real>({face[i], face[(i + 1) % 3]}, {other[j], other[(j + 1) % 3]});
            take(edges.apart, edges.squared_distance);
        }
    }
    return shortest;
}

}  // namespace gelatin::cpu
