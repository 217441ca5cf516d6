#pragma once

#include <algorithm>
#include <array>
#include <glm/geometric.hpp>
#include <limits>
#include <memory>
#include <span>
#include <vector>

#include "cpu/collision/axis_box.h"
#include "cpu/collision/box_columns.h"
#include "cpu/collision/object_tree.h"
#include "cpu/contact/contact_pair.h"
#include "cpu/contact/kept_distances.h"
#include "cpu/contact/near_at_rest.h"
#include "cpu/contact/tuning.h"
#include "cpu/nodes.h"
#include "model/contact/contact_surface.h"
#include "model/drive/attachment.h"
#include "model/model.h"

namespace gelatin::cpu {

/// A pair, and where its sides are near each other when the step begins.
template <class Real>
struct NearPair {
    ContactPair pair;
    Vec3<Real>
        normal;  ///< from the first side's nearest point to the second's, unit; 0 if these are the same
    Vec4<Real> weights;  ///< of the nodes in the nearest points
    Real gap;            ///< the distance of these [m]
    Real rounding;       ///< bound of what rounding makes of a difference of heights along the normal [m]
};

/// How far a direction separates the sides of a pair: the least of the second less the most of the first [m].
template <class Real>
Real separation(const ContactPair& pair, const Vec3<Real>& direction, std::span<const Vec4<Real>> positions) {
    const Vec3<Real> origin(positions[pair.nodes[0]]);
    Real top = 0, bottom = std::numeric_limits<Real>::infinity();
    for (std::size_t k = 1; k < 4; ++k) {
        const Real height = glm::dot(direction, Vec3<Real>(positions[pair.nodes[k]]) - origin);
        if (pair.side_of(k) == 0) {
            top = std::max(top, height);
        } else {
            bottom = std::min(bottom, height);
        }
    }
    return bottom - top;
}

/// Where the nodes of a step may go: each goes straight to within a slack of where it is expected.
template <class Real>
struct Paths {
    std::span<const Vec4<Real>> from, to;  ///< xyz [m], shape [nodes]
    Real nearness = 1;                     ///< within which part of their reach pairs are wanted
    Real slack = static_cast<Real>(tuning::kPathSlack);  ///< [thicknesses of the object]
    std::span<const Vec4<Real>> velocities = {};  ///< when the part begins [m/s], shape [nodes]; or empty
    Real step = 0;                                ///< of the part [s]
};

/// Lists all pairs of surface nodes and faces, and of surface edges, that may come as near as their paths say
/// while nodes keep to these. The same list, in the same order, for any number of threads.
template <class Real>
class FindPairs {
public:
    /// @param own whether bodies meet themselves
    FindPairs(std::shared_ptr<const Model> model, std::shared_ptr<const ContactSurface> surface, bool own);

    /// Finds boxes; run() has to follow. @param own whether bodies meet themselves, if they do at all
    /// @param asleep bodies, whose pairs are listed only with what moves, shape [bodies], or empty
    void begin(const Paths<Real>& paths, bool own = true, std::span<const std::uint8_t> asleep = {});
    /// Which bodies do not meet each other.
    void set_joined(JoinedBodies joined) { joined_ = std::move(joined); }
    /// Nodes were set from outside.
    void forget() { std::fill(is_still_.begin(), is_still_.end(), std::uint8_t(0)); }
    /// Of objects whose boxes meet, how far one goes beside the other, and of bodies that meet themselves, a
    /// node beside the mean of all; in reaches, at most.
    Real fastest_approach(const Paths<Real>& paths) const;
    void run(const Paths<Real>& paths);
    /// Lists the pairs of these nodes anew, as their paths have changed, and those that find_lost() wants,
    /// behind all others. @return how many others there are
    std::size_t update(const Paths<Real>& paths, std::span<const std::uint32_t> nodes);
    /// Finds where bodies may meet themselves on the way to `ends`, though pairs were left out, as they
    /// hardly deformed there. @return whether they do somewhere: then update() has to follow
    bool find_lost(std::span<const Vec4<Real>> ends);
    const std::vector<NearPair<Real>>& pairs() const { return pairs_; }

private:
    // Of all nodes, faces, edges and nodes of trees, round their motions relative to their object.
    struct Boxes {
        std::vector<AxisBox<Real>> nodes, faces, edges, trees;
        BoxColumns<Real> face_columns, edge_columns;
        std::vector<AxisBox<Real>> changed_faces, changed;  // of those that have changed; of trees of these
    };
    // Of a tree of faces. What is near it is found before what is near its leaves.
    struct Subtree {
        std::uint32_t object, root;
    };
    struct Found {
        std::vector<std::uint32_t> objects;              // near the subtree
        std::vector<Range> starts;                       // nodes near the subtree, of all these objects
        std::vector<std::uint32_t> leaves;               // of its own body near a leaf
        std::vector<std::uint32_t> start_counts;         // of each
        std::array<std::vector<Range>, 2> faces, edges;  // of leaves near the leaf; of new ones, between
                                                         // which a body lost something
        std::vector<AxisBox<Real>> boxes;
        std::vector<BoxPair> meeting;
        std::vector<ContactPair> maybe_nodes, maybe_edges;  // of all leaves, as their boxes meet
        std::vector<NearPair<Real>> of_nodes, of_edges;
    };
    // Of a body that is convex at the start: only those of its own pairs are listed whose lines then meet
    // boxes round lost tets.
    struct Own {
        std::vector<LostTets> lost;
        BoxColumns<Real> boxes;    // of each
        AxisBox<Real> all;         // round the boxes
        std::uint32_t listed = 0;  // the first boxes, whose pairs are listed
    };
    void update_boxes(std::size_t object, const Paths<Real>& paths);
    void find_own(const Paths<Real>& paths);
    void add_lost(std::uint32_t object, std::span<const LostTets> lost);
    bool has_changed_node(const Face& face) const;
    bool has_changed(std::uint32_t object, std::uint32_t node) const;
    bool has_changed_node(const ContactPair& pair) const;
    void search_all(const Paths<Real>& paths, bool changed);
    void search(const Subtree& subtree, const Paths<Real>& paths, bool changed, Found& found) const;
    void search(const Subtree& leaf, std::uint32_t other, std::span<const Range> starts, bool changed,
                Found& found) const;
    template <class Use>
    void walk(const Subtree& from, std::uint32_t object, std::span<const Range> starts, bool changed,
              const Use& use) const;
    void add_leaf(const Subtree& from, std::uint32_t object, std::uint32_t leaf, Found& found) const;
    template <class Use>
    void for_meeting(const BoxColumns<Real>& columns, const std::array<std::vector<Range>, 2>& ranges,
                     const Use& use, Found& found) const;
    bool may_meet(std::uint32_t object, std::uint32_t other) const;
    bool is_kept(const Own& own, std::uint32_t count, std::uint32_t node, std::uint32_t other) const;
    void keep_near(const Paths<Real>& paths, std::span<const ContactPair> candidates,
                   std::vector<NearPair<Real>>& kept) const;

    std::shared_ptr<const Model> model_;
    std::shared_ptr<const ContactSurface> surface_;
    bool own_, finds_own_ = false;
    JoinedBodies joined_;
    KeptDistances<Real> kept_;
    NearAtRest<Real> near_at_rest_;  // of bodies that are not convex
    std::vector<Own> owns_;
    std::vector<AxisBox<Real>> rest_boxes_;  // of the faces at the start, by node of the trees
    Boxes boxes_;
    std::vector<std::uint8_t> is_still_;  // objects that rest, or colliders that stay where they are
    std::vector<std::uint8_t> is_changed_, is_changed_face_, has_changed_;  // nodes, faces, objects; update()
    std::vector<AxisBox<Real>> bounding_boxes_;
    std::vector<Vec3<Real>> motions_;  // of objects on average [m]
    ObjectTree<Real> object_tree_;
    std::vector<Subtree> subtrees_;  // of all trees, in the order of their leaves
    std::vector<Found> found_;       // by subtree
    std::vector<NearPair<Real>> pairs_;
};

}  // namespace gelatin::cpu
