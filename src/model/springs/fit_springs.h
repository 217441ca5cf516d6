#pragma once

#include <glm/vec2.hpp>
#include <vector>

#include "mesh/tet_mesh.h"

namespace gelatin {

/// A spring of a body whose shear modulus is 1 Pa.
struct UnitSpring {
    glm::uvec2 nodes;  ///< the first smaller
    double stiffness;  ///< [m]: N/m for 1 Pa, > 0; grows with the body's size
};

/// Springs fitted to a mesh, and the resulting moduli.
struct FittedSprings {
    std::vector<UnitSpring> springs;  ///< each pair of nodes at most once, in ascending order
    /// The smallest and the largest Young's modulus over thirteen directions, relative to the requested one.
    double softest = 1.0, stiffest = 1.0;
};

/// Shear modulus divided by Young's modulus at Poisson's ratio 1/4, which springs have.
constexpr double kShearOverYoungs = 0.4;

/// Springs that give a mesh the requested Young's modulus. They join the ends of the tets' edges, the corners
/// opposite an inner face, and the corners across a surface edge. Stiffnesses come from a fit of each node's
/// springs to the isotropic continuum (moment_fit.h), followed by one factor from the response of the whole
/// body (elastic_response.h). They depend on the mesh only: for Young's modulus E, and a mesh that was scaled
/// by c, stiffness is kShearOverYoungs * E * c times that of the unscaled mesh. Linear in the mesh's size;
/// the same bits for any number of threads.
FittedSprings fit_springs(const TetMesh& mesh);

}  // namespace gelatin
