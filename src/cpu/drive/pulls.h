#pragma once

#include <utility>
#include <vector>

#include "cpu/elasticity/elements.h"
#include "cpu/nodes.h"
#include "model/drive/acted_nodes.h"

namespace gelatin::cpu {

/// Pulls and forces that act on nodes from outside. GLSL twin: sim/drive/pull.glsl.
template <class Real>
class Pulls {
public:
    explicit Pulls(std::size_t node_count) : acted_(node_count) {}

    void set_pulls(std::vector<Pull> pulls) { acted_.set_pulls(std::move(pulls)); }
    void move_pull(std::size_t pull, const glm::dvec3& target) { acted_.move_pull(pull, target); }
    void set_forces(std::span<const glm::vec3> forces) { acted_.set_forces(forces); }

    const std::vector<std::uint32_t>& nodes() const { return acted_.nodes(); }

    /// The force [N] over a step of `step` seconds. That of the spring is as implicit Euler would find it for
    /// this node on its spring alone: light nodes on strong springs stay stable in explicit schemes too.
    Vec3<Real> force(std::uint32_t node, const Vec4<Real>& position, const Vec3<Real>& velocity,
                     Real step) const {
        const Vec4<Real> spring(of(node).spring), force(of(node).force);
        const Real time = step + force.w;
        const Vec3<Real> offset = Vec3<Real>(spring) - Vec3<Real>(position);
        return Vec3<Real>(force) +
               spring.w / (Real(1) + spring.w * position.w * step * time) * (offset - time * velocity);
    }

    /// For block descent: combines the target of a node [m] and its weight [N/m] with those of the spring and
    /// the force, for a step of `step` seconds from `start`.
    Vec4<Real> with_target(std::uint32_t node, const Vec4<Real>& target, const Vec3<Real>& start,
                           Real step) const {
        const Vec4<Real> spring(of(node).spring), force(of(node).force);
        const PointSpring<Real> inertia{Vec3<Real>(target), target.w}, hand{Vec3<Real>(spring), spring.w};
        const auto [place, stiffness] = both(inertia, damped_point_spring(hand, start, force.w / step));
        return {place + Vec3<Real>(force) / stiffness, stiffness};
    }

    /// The force [N] on a node that a step of `step` seconds brought from `start` to `position`.
    Vec3<Real> force_at_end(std::uint32_t node, const Vec4<Real>& position, const Vec3<Real>& start,
                            Real step) const {
        const Vec4<Real> spring(of(node).spring), force(of(node).force);
        const auto [place, stiffness] =
            damped_point_spring<Real>({Vec3<Real>(spring), spring.w}, start, force.w / step);
        return Vec3<Real>(force) + stiffness * (place - Vec3<Real>(position));
    }

private:
    const NodeActions& of(std::uint32_t node) const { return acted_.by_node()[node]; }

    ActedNodes acted_;
};

}  // namespace gelatin::cpu
