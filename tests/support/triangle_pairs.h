#pragma once

#include <cmath>
#include <vector>

#include "cpu/collision/triangle_overlap.h"

namespace gelatin::test {

template <class Real>
struct TrianglePair {
    cpu::Triangle<Real> s, t;
};

/// Triangles of 0.1 to 1 m close to one another: in six of ten pairs the boxes meet, in one or two the
/// triangles do.
template <class Real>
std::vector<TrianglePair<Real>> random_pairs(std::size_t count, unsigned seed);

/// Ways for two triangles to touch, to miss one another closely, or to be less than triangles.
enum class PairKind {
    shared_vertex,
    shared_edge,
    identical,
    vertex_on_face,  // or in its plane near it
    edge_on_edge,
    vertex_on_edge,
    coplanar,
    parallel,  // apart by less than a micrometre
    sliver,
    segment,
    point,
    collinear,
    integer_grid,
};
struct NamedKind {
    PairKind kind;
    const char* name;
};
inline constexpr NamedKind kPairKinds[] = {
    {PairKind::shared_vertex, "shared_vertex"},
    {PairKind::shared_edge, "shared_edge"},
    {PairKind::identical, "identical"},
    {PairKind::vertex_on_face, "vertex_on_face"},
    {PairKind::edge_on_edge, "edge_on_edge"},
    {PairKind::vertex_on_edge, "vertex_on_edge"},
    {PairKind::coplanar, "coplanar"},
    {PairKind::parallel, "parallel"},
    {PairKind::sliver, "sliver"},
    {PairKind::segment, "segment"},
    {PairKind::point, "point"},
    {PairKind::collinear, "collinear"},
    {PairKind::integer_grid, "integer_grid"},
};

/// Pairs of a kind, by turns of 1 m at the origin, of 1 m but 1 to 1,000 km away, of 1 nm to 1 um, and of 1
/// to 1,000 km; every second one with some coordinates moved by up to four units in the last place.
template <class Real>
std::vector<TrianglePair<Real>> degenerate_pairs(PairKind kind, std::size_t count, unsigned seed);

/// The same pairs times a power of two, which rounds nothing.
template <class Real>
std::vector<TrianglePair<Real>> scaled(std::vector<TrianglePair<Real>> pairs, int exponent) {
    for (auto& pair : pairs) {
        for (auto* t : {&pair.s, &pair.t}) {
            for (auto& p : *t) p *= Real(std::ldexp(1.0, exponent));
        }
    }
    return pairs;
}

}  // namespace gelatin::test
