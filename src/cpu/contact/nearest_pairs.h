#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>

#include "cpu/contact/contact_pair.h"
#include "cpu/nodes.h"

namespace gelatin::cpu {

/// Pairs that are measured at a time.
constexpr std::size_t kPairBlock = 8;

/// Where pairs are near each other, one in each column.
template <class Real>
struct alignas(32) MeasuredPairs {
    using Column = std::array<Real, kPairBlock>;
    std::array<Column, 4> weights;  ///< of the nodes in the nearest points
    std::array<Column, 3> apart;    ///< from the first side's to the second's [m]
    Column gaps;                    ///< its length [m]
    Column rounding;                ///< bound of what rounding makes of a difference of heights along it [m]
};

/// Measures up to kPairBlock pairs, all of nodes and faces or all of edges; in float with SIMD for the
/// processor it runs on.
void measure_pairs(std::span<const ContactPair> pairs, std::span<const glm::vec4> positions,
                   MeasuredPairs<float>& measured);
void measure_pairs(std::span<const ContactPair> pairs, std::span<const glm::dvec4> positions,
                   MeasuredPairs<double>& measured);

/// Bound of what rounding makes of a difference of the nodes' heights along a direction [m].
float rounding_along(const glm::vec3& direction, const ContactPair& pair,
                     std::span<const glm::vec4> positions);
double rounding_along(const glm::dvec3& direction, const ContactPair& pair,
                      std::span<const glm::dvec4> positions);

/// Measures any number of pairs, block by block. use(p, measured, column) for each of them, in their order.
template <class Real, class Use>
void for_measured(std::span<const ContactPair> pairs, std::span<const Vec4<Real>> positions, const Use& use) {
    for (std::size_t first = 0; first < pairs.size(); first += kPairBlock) {
        const auto block = pairs.subspan(first, std::min(kPairBlock, pairs.size() - first));
        MeasuredPairs<Real> measured;
        measure_pairs(block, positions, measured);
        for (std::size_t column = 0; column < block.size(); ++column) use(first + column, measured, column);
    }
}

}  // namespace gelatin::cpu
