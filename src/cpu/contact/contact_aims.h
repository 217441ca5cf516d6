#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "cpu/contact/contact_list.h"
#include "cpu/contact/nearest_pairs.h"
#include "cpu/contact/node_contacts.h"
#include "cpu/nodes.h"
#include "model/contact/contact_surface.h"
#include "model/model.h"

namespace gelatin::cpu {

/// Where the sides of a pair were nearest when it was aimed last.
template <class Real>
struct PairAim {
    Vec3<Real> normal;  ///< from the first side to the second, unit
    Real gap;           ///< [m]
    Real yielding;      ///< the part of the nodes' stiffness that is inertia, in (0, 1]
};

/// What follows an aim.
enum class AimFor {
    guess,   ///< a guarded move, which needs nothing but the pairs; then another aim
    sweeps,  ///< nodes one by one
};

/// Aims the pairs of a list (docs/contact.md). To aim a pair means to freeze the direction between its
/// nearest points, and to divide the gap between its sides by a plane. Until the next aim, each node has a
/// half space of its own for each of its pairs and a convex term (ContactShare) which depends on nothing but
/// the node's own position: NodeContacts. So nodes move at once without looking at others, and while each
/// keeps to its half spaces and its room, no face passes through another.
template <class Real>
class ContactAims {
public:
    ContactAims(std::shared_ptr<const Model> model, std::shared_ptr<const ContactSurface> surface);

    /// To be called when a step's targets and starts are known, which must stay where they are until its end.
    void begin(Real step, std::span<const Vec4<Real>> targets, std::span<const Vec4<Real>> starts);

    /// Forgets all, because pairs are listed anew.
    void forget() {
        grips_.clear();
        aims_.clear();
        presses_.clear();
    }

    /// Aims all pairs at `positions`. @pre they keep to the list
    void run(const ContactList<Real>& list, std::span<const Vec4<Real>> positions,
             AimFor use = AimFor::sweeps);

    /// Carries what friction holds on to a new list, whose pairs have no aims yet. @param old those before
    void carry_over(const std::vector<ContactPair>& old, const ContactList<Real>& list);
    /// What friction and pressure hold when a step ends.
    void end(const ContactList<Real>& list, std::span<const Vec4<Real>> positions);

    const std::vector<PairAim<Real>>& aims() const { return aims_; }  ///< in the order of the list's pairs
    const std::vector<Press<Real>>& presses() const { return presses_; }  ///< in the order of their pairs
    Real thickness(std::size_t object) const { return static_cast<Real>(surface_->thicknesses[object]); }
    /// Gap at which a pair begins to press [m].
    Real reach(const ContactPair& pair) const { return static_cast<Real>(pair.reach); }
    const NodeContacts<Real>& nodes() const { return nodes_; }

    /// What a press held when the last step ended, which it may give back [J].
    /// @param number in presses()
    Real energy(std::size_t number) const { return energies_[number]; }

    /// The friction on the first side of a pair when the last step ended [N].
    const Vec3<Real>& held(std::uint32_t pair) const { return grips_[pair].held; }

    /// The gap between the points that were nearest at the aim, along its normal [m].
    Real gap(const ContactPair& pair, const Press<Real>& press, std::span<const Vec4<Real>> positions) const;
    /// What would hold the first side there, if nothing slid [N].
    Vec3<Real> hold(const ContactPair& pair, const Press<Real>& press,
                    std::span<const Vec4<Real>> positions) const;
    /// The most that friction may be at a gap [N].
    Real limit(Real gap, const Press<Real>& press) const {
        return press.friction * contact_force(gap, press.reach, press.stiffness);
    }

private:
    // How a pair's sides share what there is.
    struct Division {
        Real stiffness, share, yielding;  // as of Press and PairAim
    };
    void aim_pairs(const ContactList<Real>& list, const Range& pairs, std::span<const Vec4<Real>> positions,
                   AimFor use, std::vector<Press<Real>>& presses);
    Division divide(const ContactPair& pair, const Vec4<Real>& weights) const;
    void divide_gap(const ContactPair& pair, const MeasuredPairs<Real>& measured, std::size_t column,
                    const Vec3<Real>& normal, Real reach, Real share);
    Vec3<Real> slip(const ContactPair& pair, const Press<Real>& press,
                    std::span<const Vec4<Real>> positions) const;

    std::shared_ptr<const Model> model_;
    std::shared_ptr<const ContactSurface> surface_;
    std::span<const Vec4<Real>> starts_;
    // How a node yields to a force [m/N], and the part of its stiffness that is inertia; 0 where it is held.
    struct Softness {
        Real value, inertia;
    };
    std::vector<Softness> softness_;  // by node
    std::vector<PairAim<Real>> aims_;
    std::vector<Press<Real>> presses_;
    std::vector<Real> energies_;                   // by press
    std::vector<std::vector<Press<Real>>> found_;  // of each task, in the order of the pairs
    std::vector<Grip<Real>> grips_;                // by pair
    NodeContacts<Real> nodes_;
};

}  // namespace gelatin::cpu
