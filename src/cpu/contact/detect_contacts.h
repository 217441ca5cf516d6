#pragma once

#include <memory>
#include <span>
#include <vector>

#include "cpu/collision/collision.h"
#include "cpu/collision/object_tree.h"
#include "cpu/contact/contact_list.h"
#include "cpu/proximity/find_proximities.h"
#include "model/contact/contact_surface.h"
#include "model/model.h"

namespace gelatin::cpu {

/// Pairs are listed that are nearer than this times the reach.
constexpr double kListedReach = 4.0;

/// Lists the pairs of surface nodes and faces, and of edges, of different bodies that are near each other,
/// and how far every node may go before others could meet (docs/contact.md).
template <class Real>
class DetectContacts {
public:
    DetectContacts(std::shared_ptr<const Model> model, std::shared_ptr<const ContactSurface> surface);

    double listed_distance() const { return listed_; }  ///< [m]

    /// @param longest motion that the next step is expected to make [m]
    void run(std::span<const Vec4<Real>> positions, double longest, ContactList<Real>& list);

private:
    void find_islands(ContactList<Real>& list);
    void list_pairs(ContactList<Real>& list) const;
    void assign_slots(ContactList<Real>& list) const;
    void find_rooms(ContactList<Real>& list) const;
    Real distance_to_others(std::uint32_t leaf, Real most) const;

    std::shared_ptr<const Model> model_;
    std::shared_ptr<const ContactSurface> surface_;
    std::vector<std::uint32_t> object_of_;  // by node
    double listed_;                         // proximities are found up to here [m]
    double island_distance_ = 0.0;          // bodies farther apart than this are of different islands [m]
    std::unique_ptr<Collision<Real>> collision_;
    FindProximities<Real> proximities_;
    ObjectTree<Real> object_tree_;
    std::vector<std::vector<std::uint32_t>> near_;  // objects of the same island that are near, ascending
};

}  // namespace gelatin::cpu
