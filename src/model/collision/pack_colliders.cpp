#include "model/collision/pack_colliders.h"

#include <algorithm>
#include <cassert>
#include <glm/gtc/quaternion.hpp>
#include <variant>

#include "model/transform.h"

namespace gelatin {
namespace {

struct ColliderPacker {
    const ColliderDescription& description;

    Collider operator()(const PlaneCollider& plane) const {
        Collider c = common(0);
        c.center = glm::vec4(glm::vec3(plane.normal), static_cast<float>(plane.offset));
        return c;
    }
    Collider operator()(const Shape& shape) const { return std::visit(*this, shape); }
    Collider operator()(const BoxShape& box) const {
        Collider c = common(1);
        const glm::quat q(rotation_from_degrees(description.rotation));
        c.axis = glm::vec4(glm::vec3(0.5 * box.size), 0.0f);
        c.orientation = glm::vec4(q.x, q.y, q.z, q.w);
        return c;
    }
    Collider operator()(const SphereShape& sphere) const {
        Collider c = common(2);
        c.center.w = static_cast<float>(sphere.radius);
        return c;
    }
    Collider operator()(const CapsuleShape& capsule) const {
        Collider c = common(3);
        const glm::dvec3 half =
            rotation_from_degrees(description.rotation) * glm::dvec3(0, 0.5 * capsule.length, 0);
        c.center.w = static_cast<float>(capsule.radius);
        c.axis = glm::vec4(glm::vec3(half), 0.0f);
        return c;
    }
    Collider operator()(const TextShape&) const { return refused(); }
    Collider operator()(const FileShape&) const { return refused(); }
    Collider operator()(const MeshShape&) const { return refused(); }

    Collider refused() const {
        assert(!"no solid shape: validate() refuses it");
        return {};
    }

    Collider common(std::uint32_t kind) const {
        Collider c{};
        c.center = glm::vec4(glm::vec3(description.position), 0.0f);
        c.orientation = glm::vec4(0.0f, 0.0f, 0.0f, 1.0f);
        c.kind = kind;
        c.friction = static_cast<float>(description.friction);
        c.restitution = static_cast<float>(description.restitution);
        return c;
    }
};

}  // namespace

std::vector<Collider> pack_colliders(const std::vector<ColliderDescription>& colliders) {
    std::vector<Collider> packed;
    for (const ColliderDescription& c : colliders) packed.push_back(std::visit(ColliderPacker{c}, c.shape));
    std::stable_sort(packed.begin(), packed.end(),
                     [](const Collider& a, const Collider& b) { return a.kind < b.kind; });
    return packed;
}

}  // namespace gelatin
