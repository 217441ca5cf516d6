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

/// Springs fitted to a mesh, and how it answers with them.
struct FittedSprings {
    std::vector<UnitSpring> springs;  ///< each pair of nodes at most once, in ascending order
    /// The least and the greatest Young's modulus over thirteen directions, over the one asked for.
    double softest = 1.0, stiffest = 1.0;
};

/// Shear modulus over Young's modulus at Poisson's ratio 1/4, which is what springs have.
constexpr double kShearOverYoungs = 0.4;

/// Springs for a mesh of which the body answers with the Young's modulus that is asked for: along the edges
/// of the tets, between corners opposite an inner face, and between corners across a surface edge.
/// Stiffnesses come from a fit of each node's springs to the isotropic continuum (moment_fit.h), and then
/// from one factor that a pull at the whole body gives (elastic_response.h). They depend on the mesh alone:
/// for Young's modulus E, and a mesh that was scaled by c, stiffness is kShearOverYoungs * E * c times that
/// of the unscaled mesh. Linear in the mesh's size; the same bits for any number of threads.
FittedSprings fit_springs(const TetMesh& mesh);

}  // namespace gelatin
