#pragma once

#include <algorithm>
#include <glm/geometric.hpp>
#include <limits>
#include <memory>
#include <span>
#include <vector>

#include "cpu/collision/axis_box.h"
#include "cpu/collision/object_tree.h"
#include "cpu/contact/contact_list.h"
#include "cpu/contact/kept_distances.h"
#include "cpu/nodes.h"
#include "model/contact/contact_surface.h"
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

/// Where the nodes of a step may go: each stays within `slack` of the straight path to where it is expected.
template <class Real>
struct Paths {
    std::span<const Vec4<Real>> from, to;  ///< xyz [m], shape [nodes]
    std::span<const Real> slacks;          ///< [m], shape [objects]
};

/// Lists all pairs of surface nodes and faces, and of surface edges, that may come nearer than their reach
/// while nodes keep to their paths. The same list, in the same order, for any number of threads.
template <class Real>
class FindPairs {
public:
    /// @param own whether bodies meet themselves
    FindPairs(std::shared_ptr<const Model> model, std::shared_ptr<const ContactSurface> surface, bool own);

    /// Finds boxes; run() has to follow.
    void begin(const Paths<Real>& paths);
    /// Of objects whose boxes meet, how far one goes beside the other, in reaches, at most.
    Real fastest_approach() const;
    void run(const Paths<Real>& paths);
    /// Whether no self-intersection arises on the way to `ends` by pairs that were left out, as it hardly
    /// deforms there.
    bool keeps_own(std::span<const Vec4<Real>> ends) const;
    void forget() { pairs_.clear(); }
    const std::vector<NearPair<Real>>& pairs() const { return pairs_; }

private:
    // Of all nodes, faces, edges and nodes of trees, round their motions.
    struct Boxes {
        std::vector<AxisBox<Real>> nodes, faces, edges, trees;
    };
    struct Near {
        std::uint32_t index;
        AxisBox<Real> box;
    };
    struct Found {
        std::vector<Near> faces, edges;  // near the current leaf
        std::vector<ContactPair> candidates;
        std::vector<NearPair<Real>> of_nodes, of_edges;
    };
    void update_boxes(std::size_t object, const Vec3<Real>& frame, const Paths<Real>& paths,
                      Boxes& boxes) const;
    void find_own(const Paths<Real>& paths);
    void search(std::uint32_t leaf, const Paths<Real>& paths, Found& found) const;
    void walk(std::uint32_t leaf, std::uint32_t object, const Boxes& boxes, Found& found) const;
    bool is_kept(std::uint32_t object, std::uint32_t leaf, std::uint32_t other) const;
    void keep_near(const Paths<Real>& paths, const Found& found, std::vector<NearPair<Real>>& kept) const;

    std::shared_ptr<const Model> model_;
    std::shared_ptr<const ContactSurface> surface_;
    bool own_;
    std::vector<std::uint32_t> object_of_;
    KeptDistances<Real> kept_;
    // By body: whether its own pairs are listed, and those alone whose lines at the start meet one of the
    // boxes round
    // lost tets; all, if there are no boxes.
    struct Own {
        bool meets_itself = false;
        std::vector<std::uint8_t> lost;  // blocks of tets
        std::vector<AxisBox<Real>> boxes;
    };
    std::vector<Own> owns_;
    std::vector<AxisBox<Real>> rest_boxes_;  // of the leaves' faces at the start, by node of the trees
    Boxes boxes_, own_boxes_;                // own: of bodies, as these see themselves
    std::vector<AxisBox<Real>> bounding_boxes_;
    std::vector<Vec3<Real>> motions_;  // of objects on average [m]
    ObjectTree<Real> object_tree_;
    std::vector<Found> found_;  // by task, in the order of the leaves
    std::vector<NearPair<Real>> pairs_;
};

}  // namespace gelatin::cpu
