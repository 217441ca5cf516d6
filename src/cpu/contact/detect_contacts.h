#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "cpu/collision/collision.h"
#include "cpu/contact/contact_list.h"
#include "cpu/contact/detect_own.h"
#include "cpu/contact/near_boxes.h"
#include "cpu/contact/near_objects.h"
#include "cpu/contact/nearest_pairs.h"
#include "model/contact/contact_surface.h"
#include "model/model.h"

namespace gelatin::cpu {

/// A body that meets itself, to be looked at.
struct OwnLook {
    std::uint32_t object;
    std::vector<std::uint32_t> places;  ///< of surface nodes, with what is near them; empty: all
};

/// Lists the pairs of surface nodes and faces, and of edges, that are near each other, and how far every node
/// may go before others could meet (docs/contact.md).
template <class Real>
class DetectContacts {
public:
    DetectContacts(std::shared_ptr<const Model> model, std::shared_ptr<const ContactSurface> surface);

    /// Looks for pairs of different bodies. Those of single bodies stay as they are.
    void run(std::span<const Vec4<Real>> positions, const Expected<Real>& expected, ContactList<Real>& list);
    /// Looks for pairs of single bodies, of which the others stay as they are.
    void run_own(std::span<const OwnLook> looks, std::span<const Vec4<Real>> positions,
                 ContactList<Real>& list);
    /// NearObjects::find_meeting, of objects that were near each other in the last run.
    std::vector<std::uint8_t> find_meeting(std::span<const Vec4<Real>> positions,
                                           std::span<const Vec3<Real>> motions) const {
        return objects_.find_meeting(positions, motions);
    }
    /// Forgets the pairs of single bodies, or of one: lists have them until the next run.
    void restart() { own_.restart(); }
    void forget_own(std::uint32_t object) { own_.forget(object); }

private:
    std::uint32_t object_of_leaf(std::uint32_t leaf) const {
        return model_->faces[model_->face_trees.nodes[leaf].first_item].object;
    }
    void find_ways(std::span<const Vec4<Real>> ends, ContactList<Real>& list);

    // The pairs of a few leaves.
    struct Found {
        NearBoxes<Real> faces, edges;                          // near some of the leaves
        std::vector<ContactPair> of_nodes, of_edges, waiting;  // waiting: to be measured
    };
    void find_pairs();
    void put_together(ContactList<Real>& list);
    void append(std::vector<ContactPair> Found::*kind, std::vector<ContactPair>& pairs) const;
    void find_own_pairs(bool any_own, ContactList<Real>& list) const;
    void find_edge_boxes(std::uint32_t leaf);
    void search(std::span<const std::uint32_t> leaves, Found& found) const;
    void search(std::uint32_t leaf, Found& found) const;
    void find_near(std::uint32_t object, const AxisBox<Real>& around, const NearObject<Real>& other,
                   Found& found) const;
    void pair_node(std::uint32_t place, Found& found) const;
    void pair_edge(std::uint32_t edge, Found& found) const;
    void keep_near(std::vector<ContactPair>& waiting, std::vector<ContactPair>& kept) const;
    Real least_gap(const ContactPair& pair, const MeasuredPairs<Real>& measured, std::size_t column) const;
    float reach(std::uint32_t object, std::uint32_t other) const {
        return static_cast<float>(surface_->reach(object, other));
    }
    void assign_slots(ContactList<Real>& list) const;
    void find_rooms(Real most, ContactList<Real>& list);
    void find_distances(std::uint32_t object, Real most);
    struct Nearest {
        Real squared;                    // distance [m^2]
        std::uint32_t leaf;              // of another object, or kNoNode
        const NearObject<Real>* object;  // its own
    };
    void find_nearest(std::uint32_t object, const AxisBox<Real>& box, Real most, Real enough,
                      Nearest& nearest) const;

    std::shared_ptr<const Model> model_;
    std::shared_ptr<const ContactSurface> surface_;
    std::vector<std::uint32_t> object_of_;  // by node
    std::unique_ptr<Collision<Real>> collision_;
    NearObjects<Real> objects_;
    DetectOwn<Real> own_;
    std::span<const Vec4<Real>> positions_;  // of this run
    std::vector<Vec4<Real>> ends_;           // of nodes, as their islands see them
    std::vector<AxisBox<Real>> edge_boxes_;  // of leaves that are near others
    // From leaves to what is nearest of other bodies [m], shape [nodes of all trees].
    std::vector<Real> distances_;
    std::vector<Found> found_;                     // in the leaves' order
    std::vector<ContactPair> own_pairs_, others_;  // while they are put together
};

}  // namespace gelatin::cpu
