#include "cpu/contact/detect_contacts.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <cmath>
#include <iterator>
#include <limits>
#include <numeric>
#include <utility>

#include "cpu/collision/walk_tree.h"
#include "cpu/contact/swept_box.h"
#include "model/for_each_index.h"

namespace gelatin::cpu {
namespace {

// Two nodes may each use this part of the distance between them.
constexpr double kRoom = 0.45;
// Of the distance between islands: how far from others rooms are looked for.
constexpr double kSearched = 0.25;

// Of the surface nodes of a body: where more are to be looked at again, all are.
constexpr double kMostLookedAt = 0.15;

constexpr std::size_t kLeavesATask = 16;

}  // namespace

template <class Real>
DetectContacts<Real>::DetectContacts(std::shared_ptr<const Model> model,
                                     std::shared_ptr<const ContactSurface> surface)
    : model_(std::move(model)),
      surface_(std::move(surface)),
      object_of_(objects_of_nodes(*model_)),
      collision_(std::make_unique<Collision<Real>>(
          model_, BroadPhase::hierarchy, CollisionDetection::continuous,
          BoxMargin<Real>::for_distance(NearObjects<Real>::most_listed(*surface_)))),
      objects_(model_, *surface_, *collision_),
      own_(model_, surface_),
      ends_(model_->positions.begin(), model_->positions.end()),
      edge_boxes_(model_->surface_parts.edges.size()),
      distances_(model_->face_trees.nodes.size()),
      found_((model_->face_trees.levels[0].size() + kLeavesATask - 1) / kLeavesATask) {
    collision_->update_boxes(ends_, ends_);  // those of colliders that rest stay
}

template <class Real>
void DetectContacts<Real>::run(std::span<const Vec4<Real>> positions, const Expected<Real>& expected,
                               ContactList<Real>& list) {
    positions_ = positions;
    objects_.run(positions, expected, list);
    find_ways(expected.ends, list);
    collision_->update_boxes(positions, ends_);
    const auto searched = static_cast<Real>(kSearched * objects_.island_distance());
    objects_.sort(searched);
    find_rooms(searched, list);
    find_pairs();
    put_together(list);
    list.is_valid = true;
}

template <class Real>
void DetectContacts<Real>::find_ways(std::span<const Vec4<Real>> ends, ContactList<Real>& list) {
    const std::vector<std::uint32_t>& nodes = model_->surface_parts.nodes;
    list.found_at.resize(nodes.size());
    list.ways.resize(nodes.size());
    for_each_index(nodes.size(), [&](std::size_t s) {
        const std::uint32_t n = nodes[s];
        const Vec3<Real> position(positions_[n]);
        list.found_at[s] = position;
        list.ways[s] =
            ends.empty() ? Vec3<Real>(0) : Vec3<Real>(ends[n]) - position - objects_.drift(object_of_[n]);
        ends_[n] = Vec4<Real>(position + list.ways[s], positions_[n].w);
    });
}

// The nodes and edges of each leaf of the trees that is near another body search together, in ascending
// order. An edge looks for those after it alone.
template <class Real>
void DetectContacts<Real>::find_pairs() {
    const std::vector<std::uint32_t>& leaves = model_->face_trees.levels[0];  // in the order of their faces
    for_each_index(0, leaves.size(), 64, [&](std::size_t k) { find_edge_boxes(leaves[k]); });
    tbb::parallel_for(std::size_t(0), found_.size(), [&](std::size_t task) {
        Found& found = found_[task];
        found.of_nodes.clear();
        found.of_edges.clear();
        const std::size_t end = std::min((task + 1) * kLeavesATask, leaves.size());
        for (std::size_t first = task * kLeavesATask, k = first + 1; first < end; ++k) {
            if (k < end && object_of_leaf(leaves[k]) == object_of_leaf(leaves[first])) continue;
            search(std::span(leaves).subspan(first, k - first), found);
            first = k;
        }
    });
}

template <class Real>
void DetectContacts<Real>::run_own(std::span<const OwnLook> looks, std::span<const Vec4<Real>> positions,
                                   ContactList<Real>& list) {
    for_each_index(0, looks.size(), 1, [&](std::size_t k) {
        const auto& [object, places] = looks[k];
        const auto most = kMostLookedAt * list.own.places(object).count;
        if (!places.empty() && list.own.is_found(object) && static_cast<double>(places.size()) < most) {
            const bool is_done = own_.run_again(object, places, positions, list.own);
            // Beside them, rooms may have become smaller than what their nodes have used.
            const auto least = static_cast<Real>(OwnRooms<Real>::kByNodes);
            if (is_done && list.own.used(object, positions) < least) return;
        }
        own_.run(object, positions, list.own);
    });
    put_together(list);
}

// Both kinds are in their order already.
template <class Real>
void DetectContacts<Real>::put_together(ContactList<Real>& list) {
    const auto goes_before = [&](const ContactPair& a, const ContactPair& b) {
        return a.rank(surface_->places) < b.rank(surface_->places);
    };
    bool any_own = false;
    const auto add = [&](std::vector<ContactPair> Found::*kind, const auto& add_own) {
        own_pairs_.clear();
        add_own(own_pairs_);
        if (own_pairs_.empty()) {
            append(kind, list.pairs);
            return;
        }
        any_own = true;
        others_.clear();
        append(kind, others_);
        std::merge(others_.begin(), others_.end(), own_pairs_.begin(), own_pairs_.end(),
                   std::back_inserter(list.pairs), goes_before);
    };
    list.pairs.clear();
    add(&Found::of_nodes, [&](std::vector<ContactPair>& own) { own_.add_node_pairs(own); });
    list.first_edges = list.pairs.size();
    add(&Found::of_edges, [&](std::vector<ContactPair>& own) { own_.add_edge_pairs(own); });
    find_own_pairs(any_own, list);
    assign_slots(list);
}

// Of all tasks, one after the other.
template <class Real>
void DetectContacts<Real>::append(std::vector<ContactPair> Found::*kind,
                                  std::vector<ContactPair>& pairs) const {
    std::vector<std::size_t> starts(found_.size() + 1, pairs.size());
    for (std::size_t k = 0; k < found_.size(); ++k) starts[k + 1] = starts[k] + (found_[k].*kind).size();
    pairs.resize(starts.back());
    for_each_index(0, found_.size(), 16, [&](std::size_t k) {
        std::copy((found_[k].*kind).begin(), (found_[k].*kind).end(),
                  pairs.begin() + static_cast<std::ptrdiff_t>(starts[k]));
    });
}

template <class Real>
void DetectContacts<Real>::find_own_pairs(bool any_own, ContactList<Real>& list) const {
    list.own_starts.assign(model_->objects.size() + 1, 0);
    list.own_pairs.clear();
    if (!any_own) return;
    for (const ContactPair& pair : list.pairs)
        if (pair.is_own()) ++list.own_starts[pair.object + 1];
    std::partial_sum(list.own_starts.begin(), list.own_starts.end(), list.own_starts.begin());
    list.own_pairs.resize(list.own_starts.back());
    std::vector<std::uint32_t> next(list.own_starts.begin(), list.own_starts.end() - 1);
    for (std::uint32_t p = 0; p < list.pairs.size(); ++p)
        if (list.pairs[p].is_own()) list.own_pairs[next[list.pairs[p].object]++] = p;
}

template <class Real>
void DetectContacts<Real>::find_edge_boxes(std::uint32_t leaf) {
    if (distances_[leaf] > Real(0)) return;
    const TreeNode& faces = model_->face_trees.nodes[leaf];
    const std::vector<glm::uvec2>& face_starts = model_->surface_parts.face_starts;
    const std::uint32_t end = face_starts[faces.first_item + faces.item_count].y;
    for (std::uint32_t e = face_starts[faces.first_item].y; e < end; ++e) {
        const FaceEdge& edge = model_->surface_parts.edges[e];
        AxisBox<Real> box = collision_->node_boxes()[edge.a];
        box.add(collision_->node_boxes()[edge.b]);
        edge_boxes_[e] = box;
    }
}

// Leaves of one object beside each other: what is near any of them is looked for once.
template <class Real>
void DetectContacts<Real>::search(std::span<const std::uint32_t> leaves, Found& found) const {
    AxisBox<Real> around;
    for (const std::uint32_t leaf : leaves)
        if (!(distances_[leaf] > Real(0))) around.add(collision_->tree_boxes()[leaf]);
    if (!(around.min.x <= around.max.x)) return;
    found.faces.clear();
    found.edges.clear();
    const std::uint32_t object = object_of_leaf(leaves[0]);
    for (const NearObject<Real>& other : objects_.meeting(object)) find_near(object, around, other, found);
    if (found.faces.is_empty()) return;
    for (const std::uint32_t leaf : leaves)
        if (!(distances_[leaf] > Real(0))) search(leaf, found);
}

template <class Real>
void DetectContacts<Real>::search(std::uint32_t leaf, Found& found) const {
    const TreeNode& faces = model_->face_trees.nodes[leaf];
    const std::vector<glm::uvec2>& face_starts = model_->surface_parts.face_starts;
    const glm::uvec2 first = face_starts[faces.first_item],
                     end = face_starts[faces.first_item + faces.item_count];
    for (std::uint32_t place = first.x; place < end.x; ++place) pair_node(place, found);
    keep_near(found.waiting, found.of_nodes);
    for (std::uint32_t edge = first.y; edge < end.y; ++edge) pair_edge(edge, found);
    keep_near(found.waiting, found.of_edges);
}

// What of another object is near some leaves. @param around their boxes
template <class Real>
void DetectContacts<Real>::find_near(std::uint32_t object, const AxisBox<Real>& around,
                                     const NearObject<Real>& other, Found& found) const {
    const BoxTree& trees = model_->face_trees;
    const std::vector<glm::uvec2>& face_starts = model_->surface_parts.face_starts;
    const AxisBox<Real> box = trimmed(swept(around, other.drift), other.spare);
    const bool is_after = other.object > object;
    const auto as_seen = [&](const AxisBox<Real>& its) {
        return trimmed(swept(its, -other.drift), other.spare);
    };
    const std::uint32_t root = trees.roots[other.object];
    for_leaves_near<Real>(trees, collision_->tree_boxes(), root, box, [&](std::uint32_t near) {
        const std::uint32_t first = trees.nodes[near].first_item, end = first + trees.nodes[near].item_count;
        for (std::uint32_t f = first; f < end; ++f) {
            if (meet(box, collision_->face_boxes()[f]))
                found.faces.add(f, as_seen(collision_->face_boxes()[f]));
        }
        if (!is_after) return;
        for (std::uint32_t e = face_starts[first].y; e < face_starts[end].y; ++e)
            if (meet(box, edge_boxes_[e])) found.edges.add(e, as_seen(edge_boxes_[e]));
    });
}

template <class Real>
void DetectContacts<Real>::pair_node(std::uint32_t place, Found& found) const {
    const std::uint32_t node = model_->surface_parts.nodes[place], object = object_of_[node];
    found.faces.for_meeting(collision_->node_boxes()[node], [&](std::uint32_t f) {
        const Face& face = model_->faces[f];
        found.waiting.push_back({{node, face.a, face.b, face.c},
                                 {},
                                 node,
                                 f,
                                 object,
                                 face.object,
                                 1,
                                 reach(object, face.object)});
    });
}

template <class Real>
void DetectContacts<Real>::pair_edge(std::uint32_t edge, Found& found) const {
    const std::vector<FaceEdge>& edges = model_->surface_parts.edges;
    const FaceEdge& first = edges[edge];
    found.edges.for_meeting(edge_boxes_[edge], [&](std::uint32_t other) {
        const FaceEdge& second = edges[other];
        found.waiting.push_back({{first.a, first.b, second.a, second.b},
                                 {},
                                 edge,
                                 other,
                                 first.object,
                                 second.object,
                                 2,
                                 reach(first.object, second.object)});
    });
}

template <class Real>
void DetectContacts<Real>::keep_near(std::vector<ContactPair>& waiting,
                                     std::vector<ContactPair>& kept) const {
    for_measured<Real>(waiting, positions_, [&](std::size_t p, const auto& measured, std::size_t column) {
        const ContactPair& pair = waiting[p];
        // Against rounding a little more.
        const Real most =
            static_cast<Real>(objects_.listed(pair.object, pair.other)) + measured.rounding[column];
        if (!(measured.gaps[column] > most) || !(least_gap(pair, measured, column) > most))
            kept.push_back(pair);
    });
    waiting.clear();
}

// No more than the gap wherever the nodes are on their ways: along the line between the nearest points.
template <class Real>
Real DetectContacts<Real>::least_gap(const ContactPair& pair, const MeasuredPairs<Real>& measured,
                                     std::size_t column) const {
    const Vec3<Real> apart(measured.apart[0][column], measured.apart[1][column], measured.apart[2][column]);
    const Vec3<Real> normal = apart / measured.gaps[column];
    Real top = -std::numeric_limits<Real>::infinity(), low = -top;
    for (std::size_t k = 0; k < 4; ++k) {
        const std::uint32_t n = pair.nodes[k];
        const Real height = measured.heights[k][column];
        const Real end = height + glm::dot(normal, Vec3<Real>(ends_[n] - positions_[n]));
        if (pair.side_of(k) == 0) {
            top = std::max({top, height, end});
        } else {
            low = std::min({low, height, end});
        }
    }
    return low - top - std::max(glm::dot(normal, objects_.drift_towards(pair.object, pair.other)), Real(0));
}

template <class Real>
void DetectContacts<Real>::assign_slots(ContactList<Real>& list) const {
    const std::vector<std::uint32_t>& places = surface_->places;
    list.row_starts.assign(model_->surface_parts.nodes.size() + 1, 0);
    for (const ContactPair& pair : list.pairs)
        for (const std::uint32_t n : pair.nodes) ++list.row_starts[places[n]];
    std::exclusive_scan(list.row_starts.begin(), list.row_starts.end(), list.row_starts.begin(), 0u);
    std::vector<std::uint32_t> next(list.row_starts.begin(), list.row_starts.end() - 1);
    for (ContactPair& pair : list.pairs)
        for (std::size_t k = 0; k < 4; ++k) pair.slots[k] = next[places[pair.nodes[k]]]++;
}

// What is not listed is farther apart than the pair's listed distance, and, if nothing of a leaf is near any
// other body's leaf, than that and the distance between the leaves' boxes, which have the margin. Each node
// may use its part of both, less the reach.
template <class Real>
void DetectContacts<Real>::find_rooms(Real most, ContactList<Real>& list) {
    const BoxTree& trees = model_->face_trees;
    list.rooms.assign(model_->surface_parts.nodes.size(), most);
    tbb::parallel_for(std::size_t(0), model_->objects.size(), [&](std::size_t o) {
        find_distances(static_cast<std::uint32_t>(o), most);
        if (!model_->is_body(o) && !model_->surfaces[o - model_->body_count()].moves) return;
        const auto besides =
            static_cast<Real>(2.0 * (kListedReach * objects_.listed_thickness(o) - surface_->thicknesses[o]));
        const std::uint32_t root = trees.roots[o], end = trees.nodes[root].skip;
        for (std::uint32_t n = root; n < end; ++n) {
            const TreeNode& leaf = trees.nodes[n];
            for (std::uint32_t f = leaf.first_item; f < leaf.first_item + leaf.item_count; ++f) {
                const Face& face = model_->faces[f];
                for (const std::uint32_t corner : {face.a, face.b, face.c}) {
                    Real& room = list.rooms[surface_->places[corner]];
                    room = std::min(room, static_cast<Real>(kRoom) * (distances_[n] + besides));
                }
            }
        }
    });
}

// Of each leaf of an object. What is far enough away for its size shares one.
template <class Real>
void DetectContacts<Real>::find_distances(std::uint32_t object, Real most) {
    const BoxTree& trees = model_->face_trees;
    const std::uint32_t root = trees.roots[object], end = trees.nodes[root].skip;
    Nearest nearest{most * most, kNoNode, nullptr};
    for (std::uint32_t n = root; n < end;) {
        const AxisBox<Real>& box = collision_->tree_boxes()[n];
        const Vec3<Real> size = box.max - box.min;
        const bool is_leaf = trees.nodes[n].item_count > 0;
        const Real enough = is_leaf ? Real(0) : glm::dot(size, size);
        find_nearest(object, box, most * most, enough, nearest);
        if (!is_leaf && !(nearest.squared > enough)) {
            ++n;
            continue;
        }
        const std::uint32_t next = trees.nodes[n].skip;
        std::fill(distances_.begin() + n, distances_.begin() + next, std::sqrt(nearest.squared));
        n = next;
    }
}

// From a box of an object to the nearest leaf of another one, up to `most`, or to any that is as near as
// `enough`. @param nearest input: of a box beside this one, which is tried first
template <class Real>
void DetectContacts<Real>::find_nearest(std::uint32_t object, const AxisBox<Real>& box, Real most,
                                        Real enough, Nearest& nearest) const {
    const BoxTree& trees = model_->face_trees;
    const std::vector<AxisBox<Real>>& boxes = collision_->tree_boxes();
    const auto look_at = [&](std::uint32_t leaf, const NearObject<Real>& other, const AxisBox<Real>& own,
                             Real squared) {
        if (!(squared < nearest.squared)) return;
        if (!model_->is_body(other.object))
            squared = std::max(squared, objects_.squared_gap(own, other.drift, leaf));
        if (squared < nearest.squared) nearest = {squared, leaf, &other};
    };
    nearest.squared = most;
    if (nearest.leaf != kNoNode) {
        const NearObject<Real>& other = *nearest.object;
        const AxisBox<Real> own = trimmed(box, other.spare);
        look_at(nearest.leaf, other, own, squared_distance(swept(own, other.drift), boxes[nearest.leaf]));
    }
    for (const NearObject<Real>& other : objects_.by_distance(object)) {
        if (!(other.squared < nearest.squared)) return;
        const AxisBox<Real> own = trimmed(box, other.spare), passed = swept(own, other.drift);
        const std::uint32_t root = trees.roots[other.object], end = trees.nodes[root].skip;
        for (std::uint32_t n = root; n < end && nearest.squared > enough;) {
            const Real squared = squared_distance(passed, boxes[n]);
            const bool is_near = squared < nearest.squared;
            if (is_near && trees.nodes[n].item_count > 0) look_at(n, other, own, squared);
            n = is_near ? n + 1 : trees.nodes[n].skip;
        }
    }
}

template class DetectContacts<float>;
template class DetectContacts<double>;

}  // namespace gelatin::cpu
