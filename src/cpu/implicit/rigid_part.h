#pragma once

#include <cstdint>
#include <glm/geometric.hpp>

#include "cpu/implicit/rigid_inertia.h"
#include "cpu/nodes.h"
#include "model/model.h"

namespace gelatin::cpu {

/// How a body moves as a rigid one, by its momentum and angular momentum; one of which nodes are held does
/// not.
template <class Real>
struct RigidPart {
    glm::dvec3 center{0.0};  ///< of mass [m]
    RigidInertia inertia;
    Twist twist;

    /// @param range its nodes
    RigidPart(const Range& range, const Nodes<Real>& nodes) {
        const glm::dvec3 origin(nodes.positions[range.first]);
        RigidSums sums;  // with momenta for forces
        for (std::uint32_t n = range.first; n < range.end(); ++n) {
            if (nodes.positions[n].w == Real(0)) return;
            const double mass = 1.0 / static_cast<double>(nodes.positions[n].w);
            sums.add(glm::dvec3(nodes.positions[n]) - origin, mass, mass * glm::dvec3(nodes.velocities[n]));
        }
        inertia = RigidInertia(sums);
        center = origin + inertia.center;
        twist = inertia.twist(sums.force, sums.moment);
    }

    /// @param position [m] @return [m/s]
    glm::dvec3 at(const Vec4<Real>& position) const { return twist.at(glm::dvec3(position) - center); }
};

}  // namespace gelatin::cpu
