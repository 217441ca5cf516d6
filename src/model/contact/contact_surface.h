#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <vector>

#include "gelatin/scene.h"
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
    /// The mass that a node of a rigid body's surface counts with in contacts [kg], 0 of others, shape
    /// [nodes].
    std::vector<float> bearing;
    /// Of each object [m]: two surfaces begin to press each other at the sum of both. A twentieth of a body's
    /// median surface edge; colliders have none.
    std::vector<double> thicknesses;
    /// By object: not 0 if it is a body whose surface is in one piece, closed and convex at the start.
    std::vector<std::uint8_t> is_convex;

    /// How two kinds of bodies press each other, a kind for each material, or colliders and bodies.
    struct Touch {
        double friction;     ///< Coulomb's coefficient; where a collider is touched, its own
        double stiffness;    ///< of contacts, as a factor
        double restitution;  ///< in [0, 1]; where a collider is touched, its own
    };
    std::vector<std::uint32_t> kinds;  ///< of each object; each collider is one by itself
    std::vector<Touch> touches;        ///< of two kinds, shape [kinds, kinds]
    std::uint32_t kind_count = 0;

    double reach(std::uint32_t object, std::uint32_t other) const {
        return thicknesses[object] + thicknesses[other];
    }
    const Touch& touch(std::uint32_t object, std::uint32_t other) const {
        return touches[kinds[object] * kind_count + kinds[other]];
    }
};

/// ContactSurface::stiffness.
std::vector<float> stiffnesses_at_rest(const Model& model);

/// @param collision friction and restitution of bodies whose materials have none, and pairs of materials
ContactSurface make_contact_surface(const Model& model, const CollisionSettings& collision);

}  // namespace gelatin
