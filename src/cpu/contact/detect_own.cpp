#include "cpu/contact/detect_own.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <numeric>
#include <utility>

#include "cpu/collision/walk_tree.h"
#include "cpu/contact/near_objects.h"
#include "model/corners.h"
#include "model/for_each_index.h"

namespace gelatin::cpu {
namespace {

// Pairs are looked for up to this times the distance up to which they are listed: the farther, the larger
// rooms can be, and the more there is to measure.
constexpr double kSearched = 2.0;
// Of what is nearer than the distance up to which pairs are listed, only that is which is nearer than this
// times its gap at rest, or than this times that distance.
constexpr double kNearer = 0.6, kAlways = 0.4;
// Cells of the lattice of a body's map, over the body's thickness, which is a twentieth of an edge.
constexpr double kCell = 80.0;
constexpr std::size_t kLeavesATask = 32;

// The same whatever the order.
template <class Real>
void lower_to(Real& value, Real least) {
    std::atomic_ref<Real> shared(value);
    Real seen = shared.load(std::memory_order_relaxed);
    while (least < seen && !shared.compare_exchange_weak(seen, least, std::memory_order_relaxed)) {
    }
}

}  // namespace

template <class Real>
DetectOwn<Real>::DetectOwn(std::shared_ptr<const Model> model, std::shared_ptr<const ContactSurface> surface)
    : model_(std::move(model)),
      surface_(std::move(surface)),
      leaf_of_faces_(model_->faces.size()),
      found_at_(model_->node_count()),
      node_boxes_(model_->surface_parts.nodes.size()),
      edge_boxes_(model_->surface_parts.edges.size()),
      face_boxes_(model_->faces.size()),
      tree_boxes_(model_->face_trees.nodes.size()),
      apart_(model_->surface_parts.nodes.size()) {
    const std::vector<std::uint32_t>& leaves = model_->face_trees.levels[0];
    for (std::uint32_t k = 0; k < leaves.size(); ++k) {
        const TreeNode& leaf = model_->face_trees.nodes[leaves[k]];
        std::fill_n(leaf_of_faces_.begin() + leaf.first_item, leaf.item_count, k);
    }
    restart();
}

template <class Real>
void DetectOwn<Real>::restart() {
    found_.assign(model_->face_trees.levels[0].size(), {});
}

template <class Real>
double DetectOwn<Real>::listed(std::uint32_t object) const {
    return 2.0 * kListedReach * surface_->thicknesses[object];
}

template <class Real>
Range DetectOwn<Real>::leaves_of(std::uint32_t object) const {
    const Range& faces = model_->objects[object].faces;
    const std::uint32_t first = leaf_of_faces_[faces.first];
    return {first, leaf_of_faces_[faces.end() - 1] + 1 - first};
}

template <class Real>
void DetectOwn<Real>::add_node_pairs(std::vector<ContactPair>& pairs) const {
    for (const Found& found : found_) pairs.insert(pairs.end(), found.of_nodes.begin(), found.of_nodes.end());
}

template <class Real>
void DetectOwn<Real>::add_edge_pairs(std::vector<ContactPair>& pairs) const {
    for (const Found& found : found_) pairs.insert(pairs.end(), found.of_edges.begin(), found.of_edges.end());
}

template <class Real>
void DetectOwn<Real>::run(std::uint32_t object, std::span<const Vec4<Real>> positions,
                          OwnRooms<Real>& rooms) {
    rooms.find(object, static_cast<Real>(kCell * surface_->thicknesses[object]), positions);
    const Range& places = rooms.places(object);
    std::fill_n(apart_.begin() + places.first, places.count, static_cast<Real>(kSearched * listed(object)));
    update_boxes(object, rooms);
    const Range range = leaves_of(object);
    std::vector<std::uint32_t> leaves(range.count);
    std::iota(leaves.begin(), leaves.end(), range.first);
    search(object, leaves, rooms);
}

// Leaves with faces that have these nodes, and all that is near them.
template <class Real>
void DetectOwn<Real>::run_again(std::uint32_t object, std::span<const std::uint32_t> places,
                                std::span<const Vec4<Real>> positions, OwnRooms<Real>& rooms) {
    rooms.find_again(object, places, positions);
    for (const std::uint32_t s : places) apart_[s] = static_cast<Real>(kSearched * listed(object));
    update_boxes(object, rooms);
    const BoxTree& trees = model_->face_trees;
    const Range range = leaves_of(object);
    std::vector<std::uint8_t> has_changed(range.count), is_near(range.count);
    const NodeFaces& around = model_->node_faces;
    for (const std::uint32_t s : places) {
        const std::uint32_t node = model_->surface_parts.nodes[s];
        for (std::uint32_t k = around.starts[node]; k < around.starts[node + 1]; ++k)
            has_changed[leaf_of_faces_[around.faces[k]] - range.first] = 1;
    }
    for (std::uint32_t k = 0; k < range.count; ++k) {
        if (has_changed[k] == 0) continue;
        const AxisBox<Real>& box = tree_boxes_[trees.levels[0][range.first + k]];
        for_leaves_near<Real>(trees, tree_boxes_, trees.roots[object], box, [&](std::uint32_t leaf) {
            is_near[leaf_of_faces_[trees.nodes[leaf].first_item] - range.first] = 1;
        });
    }
    std::vector<std::uint32_t> leaves;
    for (std::uint32_t k = 0; k < range.count; ++k)
        if (is_near[k] != 0) leaves.push_back(range.first + k);
    search(object, leaves, rooms);
}

// @param leaves among all, in the order of faces
template <class Real>
void DetectOwn<Real>::search(std::uint32_t object, std::span<const std::uint32_t> leaves,
                             OwnRooms<Real>& rooms) {
    const std::size_t tasks = (leaves.size() + kLeavesATask - 1) / kLeavesATask;
    tbb::parallel_for(std::size_t(0), tasks, [&](std::size_t task) {
        Search search;
        const std::size_t end = std::min((task + 1) * kLeavesATask, leaves.size());
        for (std::size_t k = task * kLeavesATask; k < end; ++k) {
            Found& found = found_[leaves[k]];
            found.of_nodes.clear();
            found.of_edges.clear();
            search_leaf(model_->face_trees.levels[0][leaves[k]], static_cast<Real>(listed(object)), search,
                        found);
        }
    });
    constexpr auto kPart = static_cast<Real>(OwnRooms<Real>::kRoom * OwnRooms<Real>::kLeastStretch);
    const Range& places = rooms.places(object);
    for (std::uint32_t s = places.first; s < places.end(); ++s) rooms.set_radius(s, kPart * apart_[s]);
    rooms.set_largest_radius(object, kPart * static_cast<Real>(kSearched * listed(object)));
}

template <class Real>
void DetectOwn<Real>::update_boxes(std::uint32_t object, const OwnRooms<Real>& rooms) {
    const Range &faces = model_->objects[object].faces, &places = rooms.places(object);
    for (std::uint32_t s = places.first; s < places.end(); ++s)
        found_at_[model_->surface_parts.nodes[s]] = Vec4<Real>(rooms.offset(s), Real(0));
    const auto margin = BoxMargin<Real>::for_distance(kSearched * listed(object));
    const auto box_of = [&](const auto& nodes) {
        AxisBox<Real> box;
        for (const std::uint32_t n : nodes) box.add(Vec3<Real>(found_at_[n]), margin);
        return box;
    };
    const SurfaceParts& parts = model_->surface_parts;
    for_each_index(faces.count, [&](std::size_t k) {
        const std::size_t f = faces.first + k;
        const Face& face = model_->faces[f];
        face_boxes_[f] = box_of(std::array{face.a, face.b, face.c});
        const glm::uvec2 first = parts.face_starts[f], end = parts.face_starts[f + 1];
        for (std::uint32_t s = first.x; s < end.x; ++s) node_boxes_[s] = box_of(std::array{parts.nodes[s]});
        for (std::uint32_t e = first.y; e < end.y; ++e)
            edge_boxes_[e] = box_of(std::array{parts.edges[e].a, parts.edges[e].b});
    });
    update_tree_boxes<Real>(model_->face_trees, model_->face_trees.roots[object], face_boxes_, tree_boxes_);
}

// The nodes and edges of a leaf together.
template <class Real>
void DetectOwn<Real>::search_leaf(std::uint32_t leaf, Real listed, Search& search, Found& found) {
    const BoxTree& trees = model_->face_trees;
    const SurfaceParts& parts = model_->surface_parts;
    const auto starts_of = [&](std::uint32_t n) { return parts.face_starts[trees.nodes[n].first_item]; };
    const auto ends_of = [&](std::uint32_t n) {
        return parts.face_starts[trees.nodes[n].first_item + trees.nodes[n].item_count];
    };
    const glm::uvec2 first = starts_of(leaf), end = ends_of(leaf);
    if (first == end) return;
    const std::uint32_t object = model_->faces[trees.nodes[leaf].first_item].object;
    const AxisBox<Real>& box = tree_boxes_[leaf];
    search.faces.clear();
    search.edges.clear();
    for_leaves_near<Real>(trees, tree_boxes_, trees.roots[object], box, [&](std::uint32_t near) {
        const TreeNode& faces = trees.nodes[near];
        for (std::uint32_t f = faces.first_item; f < faces.first_item + faces.item_count; ++f)
            if (meet(box, face_boxes_[f])) search.faces.add(f, face_boxes_[f]);
        for (std::uint32_t e = starts_of(near).y; e < ends_of(near).y; ++e)
            if (e > first.y && meet(box, edge_boxes_[e])) search.edges.add(e, edge_boxes_[e]);
    });
    for (std::uint32_t s = first.x; s < end.x; ++s) {
        const std::uint32_t node = parts.nodes[s];
        search.faces.for_meeting(node_boxes_[s], [&](std::uint32_t f) {
            const Face& face = model_->faces[f];
            if (!has_corner(face, node))
                search.waiting.push_back(
                    {{node, face.a, face.b, face.c}, {}, node, f, object, object, 1, 0.0f});
        });
    }
    keep_near(search, listed, found.of_nodes);
    for (std::uint32_t e = first.y; e < end.y; ++e) {
        const FaceEdge& edge = parts.edges[e];
        search.edges.for_meeting(edge_boxes_[e], [&](std::uint32_t other) {
            const FaceEdge& second = parts.edges[other];
            if (other > e && !share_end(edge, second))
                search.waiting.push_back(
                    {{edge.a, edge.b, second.a, second.b}, {}, e, other, object, object, 2, 0.0f});
        });
    }
    keep_near(search, listed, found.of_edges);
}

// Others tell their nodes how far apart they are.
template <class Real>
void DetectOwn<Real>::keep_near(Search& search, Real listed, std::vector<ContactPair>& kept) {
    search.gaps.clear();
    const auto keep = [&](std::size_t p, const auto& measured, std::size_t column) {
        const Real gap = measured.gaps[column];
        if (gap > listed) {
            tell_apart(search.waiting[p], gap);
            return;
        }
        kept.push_back(search.waiting[p]);
        search.gaps.push_back(gap);
    };
    for_measured<Real>(search.waiting, found_at_, keep);
    search.waiting.clear();
    leave_out_resting(search.gaps, static_cast<Real>(kAlways) * listed, kept);
}

// Where a mesh is narrow, parts are near each other already at rest. They need not be listed before they are
// nearer than that. A body does not press itself where it has its shape at rest.
template <class Real>
void DetectOwn<Real>::leave_out_resting(std::span<const Real> gaps, Real always,
                                        std::vector<ContactPair>& pairs) {
    std::size_t kept = 0;
    const auto keep = [&](std::size_t p, const auto& measured, std::size_t column) {
        ContactPair pair = pairs[p];
        const float at_rest = measured.gaps[column];
        if (gaps[p] > std::max(always, static_cast<Real>(kNearer) * static_cast<Real>(at_rest))) {
            tell_apart(pair, gaps[p]);
            return;
        }
        pair.reach = std::min(static_cast<float>(surface_->reach(pair.object, pair.other)), 0.5f * at_rest);
        pairs[kept++] = pair;
    };
    for_measured<float>(pairs, model_->positions, keep);
    pairs.resize(kept);
}

template <class Real>
void DetectOwn<Real>::tell_apart(const ContactPair& pair, Real gap) {
    for (const std::uint32_t n : pair.nodes) lower_to(apart_[surface_->places[n]], gap);
}

template class DetectOwn<float>;
template class DetectOwn<double>;

}  // namespace gelatin::cpu
