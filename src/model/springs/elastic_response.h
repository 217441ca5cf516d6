#pragma once

#include <Eigen/Core>
#include <utility>
#include <vector>

#include "model/springs/rest_net.h"

namespace gelatin {

/// How a body answers to uniform stress: mean strain = compliance * stress, in Voigt's order
/// (xx, yy, zz, yz, zx, xy; shear strains are engineering strains) [1/Pa].
struct ElasticResponse {
    Eigen::Matrix<double, 6, 6> compliance = Eigen::Matrix<double, 6, 6>::Zero();

    /// Young's modulus along `direction` (unit): stress over strain [Pa].
    double youngs_modulus(const Eigen::Vector3d& direction) const;
    /// The least and the greatest Young's modulus [Pa] along the axes and the diagonals of a cube and its
    /// faces.
    std::pair<double, double> youngs_modulus_range() const;
    /// Poisson's ratio, the mean of the six that the axes have.
    double poisson_ratio() const;
};

/// Pulls at the body's boundary with each of the six stresses and lets the nodes find their places: a
/// continuum of any shape answers with a uniform strain, which is where the search starts, so it has little
/// left to do.
/// @param stiffness of each spring [N/m]
/// @param start_modulus Young's modulus to start from [Pa]
/// @param tolerance what the search may leave of the energy, roughly, as a part of it
ElasticResponse measure_response(const TetMesh& mesh, const RestNet& net,
                                 const std::vector<double>& stiffness, double start_modulus,
                                 double tolerance = 1e-4);

}  // namespace gelatin
