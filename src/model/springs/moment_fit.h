#pragma once

#include <Eigen/Core>
#include <vector>

#include "model/springs/rest_net.h"

namespace gelatin {

/// What the springs of a net are fitted to, for a shear modulus of 1 Pa.
struct MomentTargets {
    std::vector<double>
        node_volumes;  ///< V_i, a quarter of the volume of each of its tets [m^3], shape [nodes]
    std::vector<Eigen::Vector3d> boundary_areas;  ///< g_i [m^2], shape [nodes]
};

/// Factors s for which `stiffness` (k, [m]: N/m for 1 Pa) is the least-squares fit to the isotropic continuum
/// with Poisson's ratio 1/4 under every uniform strain. With n the directions of a node's springs, node i
///   is in equilibrium:  -sum_j s k l n_a n_b n_c = d_bc g_a + d_ac g_b + d_ab g_c,
///   has its energy:     1/2 sum_j s k l^2 n_a n_b n_c n_d = V_i (d_ab d_cd + d_ac d_bd + d_ad d_bc).
/// Each s is at least 0.05, and stays near 1 where the equations leave it free. Equations: docs/springs.md.
/// Linear in the number of springs; the same bits for any number of threads.
std::vector<double> fit_to_moments(const RestNet& net, const std::vector<double>& stiffness,
                                   const MomentTargets& targets);

}  // namespace gelatin
