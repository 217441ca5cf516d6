#pragma once

#include <vector>

#include "cpu/nodes.h"
#include "gelatin/pull.h"

namespace gelatin::cpu {

/// Nodes that a hand holds. GLSL twin: include/pull.glsl.
template <class Real>
class Pulls {
public:
    Pulls() = default;
    Pulls(const Pull& pull, std::size_t node_count);

    const std::vector<std::uint32_t>& nodes() const { return nodes_; }
    void move(const glm::dvec3& target) { target_ = Vec3<Real>(target); }

    /// The force [N] over a step of `step` seconds, as implicit Euler has it for this node on its spring
    /// alone: light nodes on strong springs stay stable in explicit schemes too.
    Vec3<Real> force(std::uint32_t node, const Vec4<Real>& position, const Vec3<Real>& velocity,
                     Real step) const {
        const Vec4<Real>& pull = by_node_[node];
        const Real time = step + damping_time_;
        const Vec3<Real> way = target_ + Vec3<Real>(pull) - Vec3<Real>(position);
        return pull.w / (Real(1) + pull.w * position.w * step * time) * (way - time * velocity);
    }

    /// For block descent: the force [N] at `position` after a step of `step` seconds from `start`, and in w
    /// how much it falls with a way in its direction [N/m].
    Vec4<Real> terms(std::uint32_t node, const Vec3<Real>& position, const Vec3<Real>& start,
                     Real step) const {
        const Vec4<Real>& pull = by_node_[node];
        const Real damping = pull.w * damping_time_ / step;
        const Vec3<Real> force =
            pull.w * (target_ + Vec3<Real>(pull) - position) - damping * (position - start);
        return {force, pull.w + damping};
    }

private:
    std::vector<std::uint32_t> nodes_;
    std::vector<Vec4<Real>> by_node_;  // place from the target [m], stiffness [N/m]; 0: not held
    Vec3<Real> target_{0};
    Real damping_time_ = 0;
};

}  // namespace gelatin::cpu
