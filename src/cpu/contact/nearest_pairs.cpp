// As in advance_nodes_simd.cpp: a pair a lane, compiled once for each instruction set.
#include "cpu/contact/nearest_pairs.h"

#include <algorithm>

#include <cmath>
#include <glm/common.hpp>

#include "cpu/scalars.h"
#include "model/shared_constants.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "cpu/contact/nearest_pairs.cpp"
#include <hwy/foreach_target.h>  // must come before highway.h
#include <hwy/highway.h>

#include "cpu/float_lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace gelatin::cpu::HWY_NAMESPACE {

#include "cpu/contact/nearest_pair.inl"

// Rows of the last pair stand in for those that are missing.
HWY_FLATTEN void measure_block(std::span<const ContactPair> pairs, std::span<const glm::vec4> positions,
                               MeasuredPairs<float>& measured) {
    const Lanes d;
    const bool are_edges = pairs[0].is_edges();
    for (std::size_t first = 0; first < pairs.size(); first += kLanes) {
        Vec3Lanes nodes[4];
        for (std::size_t k = 0; k < 4; ++k) {
            const Columns columns = load_columns(d, [&](std::size_t l) HWY_ATTR {
                return &positions[pairs[std::min(first + l, pairs.size() - 1)].nodes[k]].x;
            });
            nodes[k] = Vec3Lanes(columns.x, columns.y, columns.z);
        }
        const NearestPair<FloatLanes> nearest =
            are_edges ? nearest_of_edges<FloatLanes>(nodes[0], nodes[1], nodes[2], nodes[3])
                      : nearest_of_node_and_face<FloatLanes>(nodes[0], nodes[1], nodes[2], nodes[3]);
        const FloatLanes gap = square_root(nearest.squared);
        const auto store = [&](FloatLanes value, MeasuredPairs<float>::Column& column)
                               HWY_ATTR { hn::StoreU(value.v, d, &column[first]); };
        store(nearest.weight_0, measured.weights[0]);
        store(nearest.weight_1, measured.weights[1]);
        store(nearest.weight_2, measured.weights[2]);
        store(nearest.weight_3, measured.weights[3]);
        store(nearest.apart.x, measured.apart[0]);
        store(nearest.apart.y, measured.apart[1]);
        store(nearest.apart.z, measured.apart[2]);
        store(gap, measured.gaps);
        store(rounding_along<FloatLanes>(nearest.apart, gap, nodes), measured.rounding);
    }
}

}  // namespace gelatin::cpu::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace gelatin::cpu {

#include "cpu/contact/nearest_pair.inl"  // NOLINT(readability-duplicate-include): for doubles

HWY_EXPORT(measure_block);

void measure_pairs(std::span<const ContactPair> pairs, std::span<const glm::vec4> positions,
                   MeasuredPairs<float>& measured) {
    HWY_DYNAMIC_DISPATCH(measure_block)(pairs, positions, measured);
}

void measure_pairs(std::span<const ContactPair> pairs, std::span<const glm::dvec4> positions,
                   MeasuredPairs<double>& measured) {
    for (std::size_t p = 0; p < pairs.size(); ++p) {
        glm::dvec3 nodes[4];
        for (std::size_t k = 0; k < 4; ++k) nodes[k] = glm::dvec3(positions[pairs[p].nodes[k]]);
        const NearestPair<double> nearest =
            pairs[p].is_edges() ? nearest_of_edges(nodes[0], nodes[1], nodes[2], nodes[3])
                                : nearest_of_node_and_face(nodes[0], nodes[1], nodes[2], nodes[3]);
        const double gap = std::sqrt(nearest.squared);
        measured.weights[0][p] = nearest.weight_0;
        measured.weights[1][p] = nearest.weight_1;
        measured.weights[2][p] = nearest.weight_2;
        measured.weights[3][p] = nearest.weight_3;
        for (int axis = 0; axis < 3; ++axis) measured.apart[std::size_t(axis)][p] = nearest.apart[axis];
        measured.gaps[p] = gap;
        measured.rounding[p] = rounding_along<double>(nearest.apart, gap, nodes);
    }
}

template <class Real>
Real rounding_of_pair(const Vec3<Real>& direction, const ContactPair& pair,
                      std::span<const Vec4<Real>> positions) {
    Vec3<Real> nodes[4];
    for (std::size_t k = 0; k < 4; ++k) nodes[k] = Vec3<Real>(positions[pair.nodes[k]]);
    return rounding_along<Real>(direction, Real(1), nodes);
}

float rounding_along(const glm::vec3& direction, const ContactPair& pair,
                     std::span<const glm::vec4> positions) {
    return rounding_of_pair<float>(direction, pair, positions);
}

double rounding_along(const glm::dvec3& direction, const ContactPair& pair,
                      std::span<const glm::dvec4> positions) {
    return rounding_of_pair<double>(direction, pair, positions);
}

}  // namespace gelatin::cpu
#endif
