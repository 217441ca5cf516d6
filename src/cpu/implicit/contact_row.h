#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>
#include <limits>
#include <span>

#include "cpu/contact/tuning.h"
#include "cpu/elasticity/elements.h"
#include "cpu/nodes.h"
#include "model/spring_packing.h"

namespace gelatin::cpu {

/// One contact in a step: two sides whose nearest points move relative to each other by
///   s = sum_k w_k d_k + turned - target,
/// with d_k the displacements of its nodes since the step began, and weights w_k that are negative on the
/// first side and positive on the second. A plane, as a first side, has no nodes.
template <class Real>
struct ContactRow {
    static constexpr Real kLeastGap = static_cast<Real>(tuning::kLinearGap);  ///< of the reach

    static constexpr std::uint32_t kMostNodes = 8;  ///< four of a contact

    std::array<std::uint32_t, kMostNodes> nodes{};
    std::array<Real, kMostNodes> weights{};
    std::uint32_t count = 0;              ///< of nodes
    std::uint32_t object = 0, other = 0;  ///< of the sides; kNoNode: a plane
    Vec3<Real> normal{0};                 ///< n, from the first side to the second, unit
    Real gap = 0;                         ///< g_0, when the step begins [m]
    Real ease = 0;                        ///< of which what a plane has not yet pushed out [m]
    Real reach = 0;                       ///< r, at which it begins to press [m]
    Real stiffness = 0;                   ///< k [N/m]
    Real damping = 0;                     ///< c: by how much less it presses as the gap opens [N/m]
    Real friction = 0;                    ///< Coulomb's coefficient
    Vec3<Real> hold{0};     ///< lambda: friction on the second side, reversed, when the step begins [N]
    Real limit = 0;         ///< L: friction holds at most so much [N]
    std::uint64_t key = 0;  ///< of the same contact in the next step
    /// What s is beside the sum, as rigid bodies rotate: by how much they leave linear displacements [m].
    Vec3<Real> turned{0};
    /// Of which this is a tie, and no contact: it never presses, and what holds it goes by its own limits.
    std::uint32_t attachment = kNoNode;
    /// Of ties: it holds along n, and not across it, with `least` at least, along n on the first side.
    bool is_along = false;
    Real least = 0;          ///< [N]
    bool is_couple = false;  ///< weights of each side sum to 0: what holds exerts a moment alone
    bool drives = false;     ///< what holds does work, or takes energy, and keeps none
    bool is_motor = false;   ///< of these
    /// By which s is less than what is displaced: where a motor wants to be, so that s stays small beside
    /// how stiff it is; of points that are held together minus what rotations of soft bodies add to linear
    /// displacements [m].
    Vec3<Real> target{0};

    bool is_tie() const { return attachment != kNoNode; }
    /// Whether its force changes with s by the same everywhere.
    bool is_linear() const {
        constexpr Real kNone = std::numeric_limits<Real>::max();
        return is_tie() && limit == kNone && (!is_along || least == -kNone);
    }
    /// Of two points that are held together.
    bool is_point() const { return is_tie() && normal == Vec3<Real>(0); }

    /// Of the colliders, where the first side is a plane.
    std::uint32_t plane() const { return static_cast<std::uint32_t>(key >> 31 & 0x7FFFFFFFu); }
    Real gap_at(const Vec3<Real>& s) const { return gap + glm::dot(normal, s); }
    /// The law of a gap (docs/contact.md): a spring that is stiff from the start, a barrier below half of the
    /// reach, and from the least gap inwards linear, so that a solver may pass through [N].
    Real force_of(Real g) const {
        if (!(g < reach)) return Real(0);
        const Real least = kLeastGap * reach;
        return g < least ? law_force(least) + law_slope(least) * (least - g) : law_force(g);
    }
    Real slope_of(Real g) const {  ///< minus its derivative [N/m]
        return g < reach ? law_slope(std::max(g, kLeastGap * reach)) : Real(0);
    }
    /// Of the law and of what friction holds with [J].
    Real energy(const Vec3<Real>& s) const {
        Real energy = 0;
        if (const Real g = gap_at(s); g < reach) {
            const Real least = kLeastGap * reach, beyond = std::max(least - g, Real(0));
            energy = law_energy(std::max(g, least)) +
                     beyond * (law_force(least) + Real(0.5) * beyond * law_slope(least));
        }
        if (!(limit > Real(0)) || drives) return energy;
        const Vec3<Real> q = held(s);
        return energy + glm::dot(q, q) / (Real(2) * stiffness);
    }
    /// Contacts never pull.
    Real pressing(const Vec3<Real>& s) const {
        const Real moved = glm::dot(normal, s);
        return std::max(force_of(gap + moved) - damping * moved, Real(0));
    }
    /// Of s what friction, or a tie, holds. Of ties nothing else is kept: along a rail s may be large, and
    /// what is held is lost in its rounding.
    template <class Vector>
    Vector held_part(const Vector& s) const {
        const Vector n(normal), along = glm::dot(n, s) * n;
        return is_along ? along : s - along;
    }
    /// What friction would hold with if nothing slid [N].
    Vec3<Real> stick(const Vec3<Real>& s) const { return hold + stiffness * held_part(s); }
    /// Coulomb: the same, but no more than the limit.
    Vec3<Real> held(const Vec3<Real>& s) const {
        const Vec3<Real> q = stick(s);
        if (is_along) return std::clamp(glm::dot(normal, q), least, limit) * normal;
        const Real length = glm::length(q);
        return length > limit ? limit / length * q : q;
    }
    /// On the second side; the first has the reverse [N].
    Vec3<Real> force(const Vec3<Real>& s) const {
        const Vec3<Real> along = pressing(s) * normal;
        return limit > Real(0) ? along - held(s) : along;
    }

private:
    // Of gaps from the least one to the reach.
    bool is_barrier(Real g) const { return g < Real(0.5) * reach; }
    Real law_energy(Real g) const {
        return stiffness * (is_barrier(g) ? Real(0.125) * reach * reach *
                                                (Real(1) + Real(2) * std::log(reach / (Real(2) * g)))
                                          : Real(0.5) * (reach - g) * (reach - g));
    }
    Real law_force(Real g) const {
        return stiffness * (is_barrier(g) ? Real(0.25) * reach * reach / g : reach - g);
    }
    Real law_slope(Real g) const {
        return stiffness * (is_barrier(g) ? Real(0.25) * reach * reach / (g * g) : Real(1));
    }
};

/// sum_k w_k d_k. @param displacements d [m], shape [nodes]
template <class Real, class Displacements>
Vec3<Real> relative(const ContactRow<Real>& row, const Displacements& displacements) {
    Vec3<Real> s(0);
    for (std::uint32_t k = 0; k < row.count; ++k)
        s += row.weights[k] * Vec3<Real>(displacements[row.nodes[k]]);
    return s;
}

/// s, where nodes are displaced by d.
template <class Real, class Displacements>
Vec3<Real> slip(const ContactRow<Real>& row, const Displacements& displacements) {
    const Vec3<Real> s = row.turned + relative(row, displacements);
    return row.is_tie() ? row.held_part(s - row.target) : s;
}

/// A row's force to first order: constant - stiffness s.
template <class Real>
struct RowTangent {
    Vec3<Real> constant{0};           ///< [N]
    SymmetricMatrix<Real> stiffness;  ///< positive semi-definite [N/m]

    Vec3<Real> force(const Vec3<Real>& s) const { return constant - stiffness * s; }
};

/// The tangent of the law at s. Along a slip friction does not change.
template <class Real>
RowTangent<Real> tangent(const ContactRow<Real>& row, const Vec3<Real>& s) {
    RowTangent<Real> t;
    if (row.pressing(s) > Real(0))
        t.stiffness.add_outer(row.slope_of(row.gap_at(s)) + row.damping, row.normal);
    if (row.is_along) {
        const Real q = glm::dot(row.normal, row.stick(s));
        if (q > row.least && q < row.limit) t.stiffness.add_outer(row.stiffness, row.normal);
    } else if (row.limit > Real(0)) {
        const Vec3<Real> q = row.stick(s);
        const Real length = glm::length(q);
        const bool slides = length > row.limit;
        const Real across = slides ? row.stiffness * row.limit / length : row.stiffness;
        t.stiffness.add_identity(across);
        t.stiffness.add_outer(-across, row.normal);
        if (slides) t.stiffness.add_outer(-across / (length * length), q);
    }
    t.constant = row.force(s) + t.stiffness * s;
    return t;
}

}  // namespace gelatin::cpu
