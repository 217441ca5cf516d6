#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "cpu/collision/collision.h"
#include "cpu/collision/object_tree.h"
#include "cpu/contact/contact_list.h"
#include "cpu/contact/nearest_pairs.h"
#include "model/contact/contact_surface.h"
#include "model/model.h"

namespace gelatin::cpu {

/// Pairs are listed that are nearer than this times the reach.
constexpr double kListedReach = 3.0;

/// Lists the pairs of surface nodes and faces, and of edges, of different bodies that are near each other,
/// and how far every node may go before others could meet (docs/contact.md).
template <class Real>
class DetectContacts {
public:
    DetectContacts(std::shared_ptr<const Model> model, std::shared_ptr<const ContactSurface> surface);

    double listed_distance() const { return listed_; }  ///< [m]

    /// What is expected to happen next.
    struct Expected {
        std::span<const Vec4<Real>> ends = {};          ///< of nodes [m], or empty: they stay
        std::span<const Vec3<Real>> motions = {};       ///< means of bodies [m], or empty: none
        std::span<const std::uint8_t> is_blocked = {};  ///< by body: not 0 if a collider is in its way
        double longest = 0.0;                           ///< motion of a node in a step [m]
    };
    void run(std::span<const Vec4<Real>> positions, const Expected& expected, ContactList<Real>& list);

private:
    void find_boxes();
    void find_ways(std::span<const Vec4<Real>> ends, ContactList<Real>& list);
    void find_near_objects();
    bool reaches(std::uint32_t collider, const AxisBox<Real>& box, Real most) const;
    Real squared_gap(const AxisBox<Real>& box, const Vec3<Real>& drift, std::uint32_t leaf) const;
    void find_meeting_objects();
    void find_islands(ContactList<Real>& list);
    void find_drifts(const Expected& expected, ContactList<Real>& list);
    Real spare_margin(std::uint32_t object, std::uint32_t other) const;
    Vec3<Real> drift_towards(std::uint32_t object, std::uint32_t other) const;
    // Faces or edges that a leaf may be near, in ascending order, and their boxes in columns.
    struct Near {
        std::vector<std::uint32_t> indices;
        std::array<std::vector<Real>, 3> lows, highs;
        std::vector<std::uint8_t> meet;  // those of them whose box meets that of a node or an edge

        void clear();
        void add(std::uint32_t index, const AxisBox<Real>& box);
        void compare(const AxisBox<Real>& box);
    };
    // The pairs of a few leaves.
    struct Found {
        Near faces, edges;                                     // near the current leaf
        std::vector<ContactPair> of_nodes, of_edges, waiting;  // waiting: to be measured
    };
    void find_pairs(ContactList<Real>& list);
    void find_edge_boxes(std::uint32_t leaf);
    void search(std::uint32_t leaf, Found& found) const;
    void find_near(std::uint32_t leaf, std::uint32_t other, Found& found) const;
    void pair_node(std::uint32_t place, Found& found) const;
    void pair_edge(std::uint32_t edge, Found& found) const;
    void keep_near(std::vector<ContactPair>& waiting, std::vector<ContactPair>& kept) const;
    Real least_gap(const ContactPair& pair, const MeasuredPairs<Real>& measured, std::size_t column) const;
    void assign_slots(ContactList<Real>& list) const;
    void find_rooms(ContactList<Real>& list);
    void find_distances(std::uint32_t object, Real most);
    struct Nearest {
        Real squared;        // distance [m^2]
        std::uint32_t leaf;  // of another object, or kNoNode
    };
    void find_nearest(std::uint32_t object, const AxisBox<Real>& box, Real most, Real enough,
                      Nearest& nearest) const;

    std::shared_ptr<const Model> model_;
    std::shared_ptr<const ContactSurface> surface_;
    std::vector<std::uint32_t> object_of_;   // by node
    double listed_;                          // proximities are found up to here [m]
    double island_distance_ = 0.0;           // bodies farther apart than this are of different islands [m]
    std::span<const Vec4<Real>> positions_;  // of this run
    std::vector<Vec4<Real>> ends_;           // of nodes, as their islands see them
    std::vector<double> masses_;             // of bodies [kg]
    std::vector<std::uint8_t> is_held_;      // by object: in part, or whole
    std::vector<AxisBox<Real>> boxes_;       // of objects where they are
    std::vector<Vec3<Real>> drifts_;         // of objects: what their islands do [m]
    std::unique_ptr<Collision<Real>> collision_;
    BoxMargin<Real> margin_;
    std::vector<AxisBox<Real>> edge_boxes_;  // of leaves that are near others
    // From leaves to what is nearest of other bodies [m], shape [nodes of all trees].
    std::vector<Real> distances_;
    std::vector<Found> found_;  // in the leaves' order
    ObjectTree<Real> object_tree_;
    // Of each object, those near it that are not both colliders, ascending; those of a body's island, and
    // colliders.
    std::vector<std::vector<std::uint32_t>> near_;
    std::vector<std::vector<std::uint32_t>> meeting_;  // of these, those whose boxes meet on their way
    // All of them by the squares of the distances between the boxes [m^2], the nearest first.
    std::vector<std::vector<std::pair<Real, std::uint32_t>>> by_distance_;
    // How thick objects are for what is listed [m]: a collider that moves needs room, too.
    std::vector<double> listed_thicknesses_;
};

}  // namespace gelatin::cpu
