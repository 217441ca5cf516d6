#pragma once

#include <glm/gtc/quaternion.hpp>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <vector>

#include "gelatin/scene.h"
#include "mesh/surface_mesh.h"
#include "mesh/tet_mesh.h"

namespace gelatin {

/// A body's mass, and how it is distributed.
struct MassMoments {
    double mass = 0.0;       ///< [kg]
    glm::dvec3 center{0.0};  ///< of mass [m]
    glm::dmat3 square{0.0};  ///< integral of r r^T over the mass, r from the centre [kg m^2]
};

/// Of what a closed surface encloses, at an even density [kg/m^3], exactly.
MassMoments solid_moments(const SurfaceMesh& surface, double density);

/// Those that a description gives instead. @param orientation of the shape's axes, which inertia refers to
MassMoments with_description(MassMoments moments, const RigidDescription& description,
                             const glm::dquat& orientation);

/// The nodes of a rigid body: those of its surface, and four inside that are on no face.
struct RigidNodes {
    TetMesh mesh;                ///< without tets; the last four nodes are those inside
    std::vector<double> masses;  ///< [kg], > 0, shape [nodes]
};

/// Point masses with the same mass, centre and inertia. Nodes of the surface have a part of the mass by area;
/// the other four, a tetrahedron, have what that leaves.
RigidNodes make_rigid_nodes(const SurfaceMesh& surface, const MassMoments& moments);

}  // namespace gelatin
