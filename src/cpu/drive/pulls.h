#pragma once

#include <vector>

#include "cpu/elasticity/elements.h"
#include "cpu/nodes.h"
#include "gelatin/pull.h"

namespace gelatin::cpu {

/// Nodes that a user pulls. GLSL twin: sim/drive/pull.glsl.
template <class Real>
class Pulls {
public:
    Pulls() = default;
    Pulls(const Pull& pull, std::size_t node_count);

    const std::vector<std::uint32_t>& nodes() const { return nodes_; }
    void move(const glm::dvec3& target) { target_ = Vec3<Real>(target); }

    /// The force [N] over a step of `step` seconds, as implicit Euler would find it for this node on its
    /// spring alone: light nodes on strong springs stay stable in explicit schemes too.
    Vec3<Real> force(std::uint32_t node, const Vec4<Real>& position, const Vec3<Real>& velocity,
                     Real step) const {
        const Vec4<Real>& pull = by_node_[node];
        const Real time = step + damping_time_;
        const Vec3<Real> offset = target_ + Vec3<Real>(pull) - Vec3<Real>(position);
        return pull.w / (Real(1) + pull.w * position.w * step * time) * (offset - time * velocity);
    }

    /// For block descent: combines the target of a node [m] and its weight [N/m] with those of the spring,
    /// for a step of `step` seconds from `start`.
    Vec4<Real> with_target(std::uint32_t node, const Vec4<Real>& target, const Vec3<Real>& start,
                           Real step) const {
        const Vec4<Real>& pull = by_node_[node];
        const PointSpring<Real> inertia{Vec3<Real>(target), target.w},
            hand{target_ + Vec3<Real>(pull), pull.w};
        const auto [place, stiffness] = both(inertia, damped_point_spring(hand, start, damping_time_ / step));
        return {place, stiffness};
    }

    /// The force [N] on a node that a step of `step` seconds brought from `start` to `position`.
    Vec3<Real> force_at_end(std::uint32_t node, const Vec4<Real>& position, const Vec3<Real>& start,
                            Real step) const {
        const Vec4<Real>& pull = by_node_[node];
        const auto [place, stiffness] =
            damped_point_spring<Real>({target_ + Vec3<Real>(pull), pull.w}, start, damping_time_ / step);
        return stiffness * (place - Vec3<Real>(position));
    }

private:
    std::vector<std::uint32_t> nodes_;
    std::vector<Vec4<Real>> by_node_;  // offset from the pull's target [m], stiffness [N/m]; 0: not held
    Vec3<Real> target_{0};
    Real damping_time_ = 0;
};

}  // namespace gelatin::cpu
