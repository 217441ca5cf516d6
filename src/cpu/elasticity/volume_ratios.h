#pragma once

#include <array>
#include <cstdint>

#include "cpu/elasticity/elements.h"
#include "cpu/nodes.h"
#include "model/elasticity/node_tets.h"
#include "model/model.h"

namespace gelatin::cpu {

/// 1 / (6 V) [1/m^3]
template <class Real>
Real inverse_six_volumes(const TetRest& rest) {
    return Real(1) / (Real(6) * static_cast<Real>(rest.volume));
}

/// True if all of these tets have between `least` and `most` of their volume at rest; in float with SIMD for
/// the present processor.
/// @param ratios output: their volume ratios, shape [tets.count], or null
bool volumes_are_within(float least, float most, const Model& model, const Range& tets,
                        const glm::vec4* positions, float* ratios);
bool volumes_are_within(double least, double most, const Model& model, const Range& tets,
                        const glm::dvec4* positions, double* ratios);

/// Calls work(tet, dJ/dx, J) for each tet of a node, with J its volume over that at rest.
/// @param node_tets of all tets of the model
template <class Real, class Work>
void for_each_volume_slope(const Model& model, const NodeTets& node_tets, std::uint32_t node,
                           const Vec4<Real>* positions, const Work& work) {
    const Vec3<Real> position(positions[node]);
    for (std::uint32_t e = node_tets.starts[node]; e < node_tets.starts[node + 1]; ++e) {
        const std::uint32_t tet = node_tets.entries[e] / 4, corner = node_tets.entries[e] % 4;
        std::array<Vec3<Real>, 3> face;
        for (std::size_t k = 0; k < 3; ++k) face[k] = positions[model.tets[tet][kOppositeCorners[corner][k]]];
        const Vec3<Real> slope = volume_slope(face[1] - face[0], face[2] - face[0],
                                              inverse_six_volumes<Real>(model.tet_rests[tet]));
        work(tet, slope, glm::dot(position - face[0], slope));
    }
}

}  // namespace gelatin::cpu
