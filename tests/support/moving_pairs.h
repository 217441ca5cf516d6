#pragma once

#include <optional>
#include <vector>

#include "cpu/collision/time_of_impact.h"

namespace gelatin::test {

/// What moves: a node and a face, two edges, or two faces. All are stored as faces; a corner that is there
/// twice or three times makes an edge or a node.
enum class PairOf { node_and_face, edges, faces };
struct NamedPairOf {
    PairOf what;
    const char* name;
};
inline constexpr NamedPairOf kPairsOf[] = {
    {PairOf::node_and_face, "node_and_face"}, {PairOf::edges, "edges"}, {PairOf::faces, "faces"}};

template <class Real>
struct MovingPair {
    cpu::Moving<Real, 3> a, b;
};

/// Of 0.1 to 1 m, flying at one another and together, deforming by a thousandth to a third of their size; a
/// fiftieth and more of them touches.
template <class Real>
std::vector<MovingPair<Real>> random_moving_pairs(PairOf what, std::size_t count, unsigned seed);

/// Pairs that touch exactly, at a quarter, half, three quarters, the start or the end of the step, with
/// corners of few bits: faces on faces, edges and nodes on one another, parallel, in one plane, along one
/// line, degenerate, at rest. By turns at the origin, far from it, tiny and large.
template <class Real>
std::vector<MovingPair<Real>> touching_pairs(PairOf what, std::size_t count, unsigned seed);

/// The same with b moved by up to 1e-8 to 1e-2 of the extent: most miss one another closely.
template <class Real>
std::vector<MovingPair<Real>> nearly_touching_pairs(PairOf what, std::size_t count, unsigned seed);

/// cpu::time_of_impact with as many corners as `what` has.
template <class Real>
std::optional<Real> impact(PairOf what, const MovingPair<Real>& pair);

/// How far a and b are apart at a time of the step [m], as if they did not pierce one another; in extended
/// precision, by the edges' and the nodes' distances.
template <class Real>
double distance_at(const MovingPair<Real>& pair, double time);

/// When they first come as near as `distance` to 2 `distance` [m], stepping through time by what the fastest
/// corner leaves of their distance; empty if they certainly do not, or if that takes more than 10,000 steps.
template <class Real>
std::optional<double> comes_near(const MovingPair<Real>& pair, double distance);

/// The largest side of the box round the pair, as seen from a's first corner [m].
template <class Real>
double extent(const MovingPair<Real>& pair);

}  // namespace gelatin::test
