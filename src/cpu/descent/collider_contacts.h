#pragma once

#include <cstdint>
#include <vector>

#include "cpu/nodes.h"

namespace gelatin::cpu {

/// How a collider holds a node.
template <class Real>
struct ColliderContact {
    Vec3<Real> force{0}, normal{0};  ///< [N], unit
    Real along = 0, across = 0;      ///< how the force changes with the body's displacement [N/m]
};

/// What colliders did in the last sweep of block descent.
template <class Real>
struct ColliderContacts {
    std::vector<std::uint32_t> object_of;      ///< by node
    std::vector<std::uint8_t> objects;         ///< not 0 where they met a collider in this step
    std::vector<ColliderContact<Real>> nodes;  ///< empty without colliders

    /// Whether the object of the node met a collider.
    bool has_contact(std::size_t node) const { return objects[object_of[node]] != 0; }
};

}  // namespace gelatin::cpu
