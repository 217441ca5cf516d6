#pragma once

#include <Eigen/Core>
#include <utility>
#include <vector>

#include "model/springs/rest_net.h"

namespace gelatin {

/// How a body responds to uniform stress: mean strain = compliance * stress, in Voigt's order (xx, yy, zz,
/// yz, zx, xy; shear strains are engineering strains) [1/Pa].
struct ElasticResponse {
    Eigen::Matrix<double, 6, 6> compliance = Eigen::Matrix<double, 6, 6>::Zero();

    /// Young's modulus along `direction` (unit): stress divided by strain [Pa].
    double youngs_modulus(const Eigen::Vector3d& direction) const;
    /// The smallest and the largest Young's modulus [Pa] along the axes and the diagonals of a cube and of
    /// its faces.
    std::pair<double, double> youngs_modulus_range() const;
    /// Poisson's ratio, the mean of the six of the axes.
    double poisson_ratio() const;
};

/// Applies each of the six stresses to the body's boundary and finds the nodes' equilibrium. A continuum of
/// any shape responds with a uniform strain. The search starts there, so few iterations are needed.
/// @param stiffness of each spring [N/m]
/// @param start_modulus Young's modulus of the initial guess [Pa]
/// @param tolerance the fraction of the energy, approximately, that may remain as an error
ElasticResponse measure_response(const TetMesh& mesh, const RestNet& net,
                                 const std::vector<double>& stiffness, double start_modulus,
                                 double tolerance = 1e-4);

}  // namespace gelatin
