#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <vector>

#include "model/model.h"
#include "model/spring_packing.h"

namespace gelatin {

/// A corner opposite an edge of a face, in the face on the edge's other side; none at an open edge, or where
/// three faces meet.
struct CornerAcross {
    std::uint32_t face = kNoNode, corner = kNoNode;  ///< the face, and the node that is its corner
};

/// What contact needs to know of the surfaces of all bodies (docs/contact.md).
struct ContactSurface {
    std::vector<std::uint32_t> places;     ///< of each node in SurfaceParts::nodes, or kNoNode inside
    std::vector<CornerAcross> across;      ///< 3 f + k: of face f's edge from corner k to k + 1
    std::vector<glm::uvec2> beside_edges;  ///< of each edge, the opposite corners of its faces, or kNoNode
    /// A third of the trace of the second derivative of the body's energy by the node at rest, without
    /// dampers [N/m], shape [nodes]: how stiff the body is there, over all directions.
    std::vector<float> stiffness;
    /// Of each object [m]: two surfaces begin to press each other at the sum of both. A twentieth of a body's
    /// median surface edge; colliders have none.
    std::vector<double> thicknesses;

    /// Of each object: Coulomb's coefficient. Where a collider is touched, its own counts.
    std::vector<double> frictions;
    std::uint32_t first_collider = 0;  ///< objects from here on are colliders

    double reach(std::uint32_t object, std::uint32_t other) const {
        return thicknesses[object] + thicknesses[other];
    }
    /// Of a pair of objects, at most one of which is a collider.
    double friction(std::uint32_t object, std::uint32_t other) const {
        return frictions[object < first_collider ? other : object];
    }
};

/// @param friction of bodies with each other
ContactSurface make_contact_surface(const Model& model, double friction);

}  // namespace gelatin
