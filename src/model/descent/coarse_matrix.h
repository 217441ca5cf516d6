#pragma once

#include <Eigen/Core>
#include <vector>

#include "model/descent/coarse_basis.h"

namespace gelatin {

/// What resists the motions of a body's clusters about its shape at rest: P^T M P and so on, with P the
/// coarse basis there. Six rows a cluster: translation [m], then rotation [radians].
struct CoarseMatrices {
    Eigen::MatrixXd inertia;  ///< of the masses
    Eigen::MatrixXd elastic;  ///< of springs, volume term and neo-Hookean tets
    Eigen::MatrixXd viscous;  ///< of their damping
    Eigen::MatrixXd rigid;    ///< inertia's part for motions of a free body as a rigid one

    /// How clusters follow forces and moments in a step of h seconds: the inverse of
    ///   inertia / h^2 + elastic + viscous / h + c rigid,
    /// with c so large that free bodies do not move as rigid ones: that is left to RigidStep, for the least
    /// inaccuracy of stiff springs' forces would move them. Shape [6 clusters, 6 clusters].
    Eigen::MatrixXd inverse(double step) const;
};

/// Of each object; empty where it has no clusters.
std::vector<CoarseMatrices> make_coarse_matrices(const Model& model, const CoarseBasis& basis);

}  // namespace gelatin
