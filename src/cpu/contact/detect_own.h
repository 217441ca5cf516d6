#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "cpu/collision/axis_box.h"
#include "cpu/contact/contact_list.h"
#include "cpu/contact/nearest_pairs.h"
#include "cpu/contact/own_boxes.h"
#include "cpu/contact/own_rooms.h"
#include "model/contact/contact_surface.h"
#include "model/model.h"

namespace gelatin::cpu {

/// Lists the pairs of single bodies that are near each other, and writes how far nodes may go before others
/// of their body could meet (docs/contact.md).
template <class Real>
class DetectOwn {
public:
    DetectOwn(std::shared_ptr<const Model> model, std::shared_ptr<const ContactSurface> surface);

    /// Looks at a body that meets itself.
    void run(std::uint32_t object, std::span<const Vec4<Real>> positions, OwnRooms<Real>& rooms);
    /// Looks again at some surface nodes of a body, which have used up their rooms.
    /// @return false if it has to be looked at as a whole
    bool run_again(std::uint32_t object, std::span<const std::uint32_t> places,
                   std::span<const Vec4<Real>> positions, OwnRooms<Real>& rooms);
    /// Forgets all bodies, or one.
    void restart();
    void forget(std::uint32_t object);

    /// Adds the pairs of all bodies as they were looked at last, in the order of lists.
    void add_node_pairs(std::vector<ContactPair>& pairs) const;
    void add_edge_pairs(std::vector<ContactPair>& pairs) const;

private:
    // Of a leaf.
    struct Found {
        std::vector<ContactPair> of_nodes, of_edges;
    };
    struct Search {
        typename OwnBoxes<Real>::Near around;
        std::vector<ContactPair> waiting, near;  // to be measured; those that are near
        std::vector<Real> gaps;                  // of these [m]
    };
    double listed(std::uint32_t object) const;
    void update_boxes(std::uint32_t object, const OwnRooms<Real>& rooms);
    void search(std::uint32_t object, std::span<const std::uint32_t> leaves, OwnRooms<Real>& rooms);
    void search_leaf(std::uint32_t leaf, Real listed, Search& search, Found& found);
    void forget_changed(std::vector<ContactPair>& pairs) const;
    void sort(std::vector<ContactPair>& pairs) const;
    bool has_changed(std::uint32_t node) const { return has_changed_[surface_->places[node]] != 0; }
    Real search_distance(std::uint32_t object, std::uint32_t place, const OwnRooms<Real>& rooms) const;
    void keep_near(Search& search, Real listed, std::vector<ContactPair>& kept);
    void leave_out_resting(std::span<const Real> gaps, Real always, std::vector<ContactPair>& pairs);
    void tell_apart(const ContactPair& pair, Real gap);

    std::shared_ptr<const Model> model_;
    std::shared_ptr<const ContactSurface> surface_;
    std::vector<Vec4<Real>> found_at_;  // by node, from the middle of its body [m]
    OwnBoxes<Real> boxes_;
    // By surface node: how far others are looked for, and from the nearest that is not listed [m]; whether it
    // is looked at.
    std::vector<Real> searched_, apart_;
    std::vector<std::uint8_t> has_changed_;
    std::vector<Found> found_;  // by leaf, in the order of faces
};

}  // namespace gelatin::cpu
