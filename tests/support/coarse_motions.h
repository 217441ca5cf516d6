#pragma once

#include <Eigen/Core>
#include <cstdlib>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <vector>

#include "model/descent/coarse_basis.h"

namespace gelatin::test {

/// How far a body's nodes go from rest by motions of its clusters, each a translation and a rotation: d = P q
/// [m], shape [nodes of the model].
inline std::vector<glm::dvec3> coarse_displacements(const Model& model, const CoarseBasis& basis,
                                                    const Range& clusters, const Eigen::VectorXd& motions) {
    std::vector<glm::dvec3> displacements(model.node_count(), glm::dvec3(0.0));
    for (std::uint32_t k = 0; k < clusters.count; ++k) {
        const Eigen::VectorXd q = motions.segment(6 * static_cast<Eigen::Index>(k), 6);
        const glm::dvec3 translation(q[0], q[1], q[2]), rotation(q[3], q[4], q[5]);
        for (const CoarseBasis::Part& part : basis.nodes_of(clusters.first + k)) {
            const glm::dvec3 arm =
                glm::dvec3(model.positions[part.index]) - basis.middles[clusters.first + k];
            displacements[part.index] +=
                static_cast<double>(part.weight) * (translation + glm::cross(rotation, arm));
        }
    }
    return displacements;
}

/// Reproducible, of the order of `size`.
inline Eigen::VectorXd random_motions(const Range& clusters, double size, unsigned seed) {
    std::srand(seed);
    return size * Eigen::VectorXd::Random(6 * static_cast<Eigen::Index>(clusters.count));
}

}  // namespace gelatin::test
