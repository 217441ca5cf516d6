#pragma once

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <vector>

#include "cpu/nodes.h"
#include "model/model.h"

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

    ColliderContacts() = default;
    explicit ColliderContacts(const Model& model)
        : object_of(objects_of_nodes(model)),
          objects(model.objects.size()),
          nodes(model.colliders.empty() ? 0 : model.node_count()) {}

    /// To be called when a step begins, after those of its nodes were taken back.
    void begin() { std::fill(objects.begin(), objects.end(), std::uint8_t(0)); }

    /// To be called when nodes were set from outside.
    void restart() {
        begin();
        std::fill(nodes.begin(), nodes.end(), ColliderContact<Real>());
    }

    /// Whether the object of the node met a collider.
    bool has_contact(std::size_t node) const { return objects[object_of[node]] != 0; }
    bool has_contact(const Range& of_objects) const {
        const auto first = objects.begin() + of_objects.first;
        return std::any_of(first, first + of_objects.count, [](std::uint8_t met) { return met != 0; });
    }
    /// Of the node's object; by several threads at once.
    void mark(std::size_t node) {
        std::atomic_ref(objects[object_of[node]]).store(1, std::memory_order_relaxed);
    }
};

}  // namespace gelatin::cpu
