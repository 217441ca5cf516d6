#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "cpu/contact/contact_law.h"
#include "cpu/contact/contact_list.h"
#include "cpu/nodes.h"
#include "model/contact/contact_limits.h"
#include "model/contact/contact_surface.h"
#include "model/model.h"

namespace gelatin::cpu {

/// How two surfaces hold each other by friction.
template <class Real>
struct Grip {
    Vec3<Real> held{0};  ///< on the first side when the step began [N], minus that on the second
    Vec3<Real> from{0};  ///< slip since then at which they came to press each other [m]
    bool grips = false;  ///< whether they have pressed each other
};

/// A pair that can press, where it was aimed last: the line between its nearest points leaves both surfaces.
template <class Real>
struct Press {
    std::uint32_t pair;
    Vec3<Real> normal;   ///< as of PairAim
    Real gap;            ///< between the nearest points [m]
    Vec4<Real> weights;  ///< of the pair's nodes in them; each side's add up to 1
    Real reach;          ///< gap at which it begins to press [m]
    Real stiffness;      ///< [N/m], positive
    Real friction;       ///< Coulomb's coefficient
    Real share;          ///< the part of the gap that the first side may use
    Grip<Real> grip;
    Vec3<Real> hold;  ///< what would hold the first side there, if nothing slid [N]; 0 without pressure
};

/// A half space that a node keeps to until the next aim.
template <class Real>
struct NodePlane {
    Vec3<Real> towards;  ///< the other side of a pair, unit
    Real head;           ///< how far the node may go along it from where it was aimed [m]; < 0: not at all
};

/// What each node knows of its pairs until the next aim (ContactAims): terms of its own, and how far it may
/// go. None of it depends on other nodes.
template <class Real>
class NodeContacts {
public:
    NodeContacts(std::shared_ptr<const Model> model, std::shared_ptr<const ContactSurface> surface);

    // An aim writes all planes, slot by slot of the list, and all shares. Then it selects.
    void resize(const ContactList<Real>& list);
    NodePlane<Real>& plane(std::uint32_t slot) { return planes_[slot]; }
    void share(const ContactList<Real>& list, const std::vector<Press<Real>>& presses);
    /// Keeps the planes that nodes at `positions` can reach within their rooms.
    void select(const ContactList<Real>& list, std::span<const Vec4<Real>> positions);

    /// Instead of these: no surface node may move until the next aim.
    void stay(std::span<const Vec4<Real>> positions);

    /// Where a surface node was aimed [m].
    Vec3<Real> aimed_at(std::uint32_t node) const { return Vec3<Real>(free_[node]); }

    bool presses(std::uint32_t node) const { return presses_[node] != 0; }
    /// Adds the terms of a node that presses.
    void add(std::uint32_t node, const Vec3<Real>& position, NodeTerms<Real>& terms) const;

    /// Where a node may go that is at `from` and would go to `to`: as far as its planes and its room allow,
    /// and to where its part of the objective is least on the way.
    /// @param all terms of the node at `from`, those of contacts among them
    Vec3<Real> limited(const ContactList<Real>& list, std::uint32_t node, const Vec3<Real>& from,
                       const Vec3<Real>& to, const NodeTerms<Real>& all) const {
        return is_free_at(node, to) ? to : limited_nearby(list, node, from, to, all);
    }

    /// For sweeps on a device. @param limits output
    void write(const ContactList<Real>& list, ContactLimits& limits) const;

    /// The part of displacements that all of some nodes may make.
    /// @param part no more than this, in [0, 1]
    Real allowed_part(const ContactList<Real>& list, const Range& nodes,
                      std::span<const Vec4<Real>> positions, std::span<const Vec3<Real>> displacements,
                      Real part) const;

private:
    // Whether nothing can be in the way between where the node is and `position`.
    bool is_free_at(std::uint32_t node, const Vec3<Real>& position) const {
        const Vec3<Real> displacement = position - Vec3<Real>(free_[node]);
        return glm::dot(displacement, displacement) <= free_[node].w;
    }
    Vec3<Real> limited_nearby(const ContactList<Real>& list, std::uint32_t node, const Vec3<Real>& from,
                              const Vec3<Real>& to, const NodeTerms<Real>& all) const;
    void select(const ContactList<Real>& list, std::uint32_t place, const Vec3<Real>& position);
    Vec3<Real> kept_to_planes(std::span<const NodePlane<Real>> planes, const Vec3<Real>& displacement,
                              Vec3<Real> motion) const;
    Real least_along(std::span<const ContactShare<Real>> shares, const Vec3<Real>& displacement,
                     const Vec3<Real>& motion, const NodeTerms<Real>& all) const;
    std::span<const NodePlane<Real>> planes_of(std::uint32_t place) const {
        return {planes_.data() + first_planes_[place], plane_counts_[place]};
    }
    std::span<const ContactShare<Real>> shares_of(std::uint32_t place) const {
        return {shares_.data() + share_starts_[place], share_starts_[place + 1] - share_starts_[place]};
    }

    std::shared_ptr<const Model> model_;
    std::shared_ptr<const ContactSurface> surface_;
    std::vector<std::uint32_t> object_of_;    // by node
    std::vector<NodePlane<Real>> planes_;     // by slot; of each node's first those that are counted
    std::vector<ContactShare<Real>> shares_;  // node by node
    // By press, of its four nodes: the places of their shares among those of the node.
    std::vector<std::array<std::uint32_t, 4>> share_places_;
    // By surface node:
    std::vector<std::uint32_t> first_planes_, plane_counts_, share_starts_;
    std::vector<std::uint8_t> is_stuck_;  // a pair could not be divided
    // By node:
    std::vector<std::uint8_t> presses_;
    // Where it was aimed [m], and the square of how far it may go from there in any direction [m^2]: not
    // limited inside a body; < 0 where terms or planes have to be looked at.
    std::vector<Vec4<Real>> free_;
};

}  // namespace gelatin::cpu
