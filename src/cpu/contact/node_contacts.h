#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "cpu/contact/contact_law.h"
#include "cpu/contact/contact_list.h"
#include "cpu/nodes.h"
#include "model/contact/contact_surface.h"
#include "model/model.h"

namespace gelatin::cpu {

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
    /// @param friction Coulomb's coefficient
    NodeContacts(std::shared_ptr<const Model> model, std::shared_ptr<const ContactSurface> surface,
                 double friction);

    // An aim writes these, slot by slot of the list, and then selects.
    void resize(const ContactList<Real>& list);
    NodePlane<Real>& plane(std::uint32_t slot) { return planes_[slot]; }
    ContactShare<Real>& share(std::uint32_t slot) { return shares_[slot]; }
    /// Keeps the planes that nodes at `positions` can reach within their rooms, and the shares that press.
    void select(const ContactList<Real>& list, std::span<const Vec4<Real>> positions);

    /// Where surface nodes were aimed [m], in the order of SurfaceParts::nodes.
    const std::vector<Vec3<Real>>& aimed_at() const { return aimed_at_; }

    bool presses(std::uint32_t node) const {
        const std::uint32_t place = surface_->places[node];
        return place != kNoNode && share_counts_[place] > 0;
    }
    /// Adds the terms of a node that presses.
    void add(std::uint32_t node, const Vec3<Real>& position, NodeTerms<Real>& terms) const;

    /// Where a node may go that is at `from` and would go to `to`: as far as its planes and its room allow,
    /// and to where its part of the objective is least on the way.
    /// @param all terms of the node at `from`, those of contacts among them
    Vec3<Real> limited(const ContactList<Real>& list, std::uint32_t node, const Vec3<Real>& from,
                       const Vec3<Real>& to, const NodeTerms<Real>& all) const;

    /// The part of displacements that all of some nodes may make.
    /// @param part no more than this, in [0, 1]
    Real allowed_part(const ContactList<Real>& list, const Range& nodes,
                      std::span<const Vec4<Real>> positions, std::span<const Vec3<Real>> displacements,
                      Real part) const;

private:
    void select(const ContactList<Real>& list, std::uint32_t place, const Vec3<Real>& position);
    Vec3<Real> kept_to_planes(std::span<const NodePlane<Real>> planes, const Vec3<Real>& displacement,
                              Vec3<Real> motion) const;
    Real least_along(std::span<const ContactShare<Real>> shares, const Vec3<Real>& displacement,
                     const Vec3<Real>& motion, const NodeTerms<Real>& all) const;
    std::span<const NodePlane<Real>> planes_of(std::uint32_t place) const {
        return {planes_.data() + first_slots_[place], plane_counts_[place]};
    }
    std::span<const ContactShare<Real>> shares_of(std::uint32_t place) const {
        return {shares_.data() + first_slots_[place], share_counts_[place]};
    }

    std::shared_ptr<const Model> model_;
    std::shared_ptr<const ContactSurface> surface_;
    std::vector<std::uint32_t> object_of_;  // by node
    Real friction_;
    // By slot; of each node's first those that are counted:
    std::vector<NodePlane<Real>> planes_;
    std::vector<ContactShare<Real>> shares_;
    // By surface node:
    std::vector<std::uint32_t> first_slots_, plane_counts_, share_counts_;
    std::vector<std::uint8_t> is_stuck_;  // a pair could not be divided
    std::vector<Vec3<Real>> aimed_at_;    // [m]
};

/// The part of a motion from u, inside a ball round the origin, that stays in it.
template <class Real>
Real part_within(const Vec3<Real>& u, const Vec3<Real>& motion, Real radius);

}  // namespace gelatin::cpu
