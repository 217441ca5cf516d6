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

HWY_INLINE Vec3Lanes larger(const Vec3Lanes& a, const Vec3Lanes& b) {
    return {larger(a.x, b.x), larger(a.y, b.y), larger(a.z, b.z)};
}
HWY_INLINE Vec3Lanes magnitude(const Vec3Lanes& v) {
    return larger(v, Vec3Lanes(FloatLanes(0.0f)) - v);
}

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
        const FloatLanes gap = square_root(nearest.squared), none(0.0f);
        const Vec3Lanes normal = select(gap > none, FloatLanes(1.0f) / gap, none) * nearest.apart;
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
        Vec3Lanes extent(none), reach = magnitude(nodes[0]);
        store(none, measured.heights[0]);
        for (std::size_t k = 1; k < 4; ++k) {
            const Vec3Lanes relative = nodes[k] - nodes[0];
            store(dot(normal, relative), measured.heights[k]);
            extent = larger(extent, magnitude(relative));
            reach = larger(reach, magnitude(nodes[k]));
        }
        const Vec3Lanes size = multiply_add(FloatLanes(8.0f), extent, FloatLanes(4.0f) * reach);
        store(FloatLanes(kEpsilon<float>) * dot(magnitude(normal), size), measured.rounding);
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
        std::array<glm::dvec3, 4> nodes;
        for (std::size_t k = 0; k < 4; ++k) nodes[k] = glm::dvec3(positions[pairs[p].nodes[k]]);
        const NearestPair<double> nearest =
            pairs[p].is_edges() ? nearest_of_edges(nodes[0], nodes[1], nodes[2], nodes[3])
                                : nearest_of_node_and_face(nodes[0], nodes[1], nodes[2], nodes[3]);
        const double gap = std::sqrt(nearest.squared);
        const glm::dvec3 normal = gap > 0.0 ? nearest.apart / gap : glm::dvec3(0.0);
        measured.weights[0][p] = nearest.weight_0;
        measured.weights[1][p] = nearest.weight_1;
        measured.weights[2][p] = nearest.weight_2;
        measured.weights[3][p] = nearest.weight_3;
        for (int axis = 0; axis < 3; ++axis) measured.apart[std::size_t(axis)][p] = nearest.apart[axis];
        measured.gaps[p] = gap;
        glm::dvec3 extent(0.0), reach(0.0);
        for (std::size_t k = 0; k < 4; ++k) {
            const glm::dvec3 relative = nodes[k] - nodes[0];
            measured.heights[k][p] = glm::dot(normal, relative);
            extent = glm::max(extent, glm::abs(relative));
            reach = glm::max(reach, glm::abs(nodes[k]));
        }
        measured.rounding[p] = kEpsilon<double> * glm::dot(glm::abs(normal), 8.0 * extent + 4.0 * reach);
    }
}

}  // namespace gelatin::cpu
#endif
