#include "cpu/contact/detect_contacts.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <cmath>
#include <numeric>
#include <utility>

#include "model/for_each_index.h"

namespace gelatin::cpu {
namespace {

// Two nodes may each use this part of the distance between them.
constexpr double kRoom = 0.45;
// Parts of the distance between islands: how far from others rooms are looked for, and how far an island may
// go. With rooms of 0.45 (1/4 + 1/4) and shifts of 1/5, nodes of two islands do not meet.
constexpr double kSearched = 0.25, kShifted = 0.2;

double greatest_reach(const ContactSurface& surface) {
    return 2.0 * *std::max_element(surface.thicknesses.begin(), surface.thicknesses.end());
}

template <class Real>
Real squared_distance(const AxisBox<Real>& a, const AxisBox<Real>& b) {
    const Vec3<Real> apart = glm::max(glm::max(a.min - b.max, b.min - a.max), Vec3<Real>(0));
    return glm::dot(apart, apart);
}

}  // namespace

template <class Real>
DetectContacts<Real>::DetectContacts(std::shared_ptr<const Model> model,
                                     std::shared_ptr<const ContactSurface> surface)
    : model_(std::move(model)),
      surface_(std::move(surface)),
      object_of_(objects_of_nodes(*model_)),
      listed_(kListedReach * greatest_reach(*surface_)),
      collision_(std::make_unique<Collision<Real>>(model_, BroadPhase::hierarchy,
                                                   CollisionDetection::discrete,
                                                   BoxMargin<Real>::for_distance(listed_))),
      proximities_(model_, *collision_, listed_, false),
      object_tree_(static_cast<std::uint32_t>(model_->objects.size())),
      near_(model_->objects.size()) {}

template <class Real>
void DetectContacts<Real>::run(std::span<const Vec4<Real>> positions, double longest,
                               ContactList<Real>& list) {
    island_distance_ = 4.0 * (listed_ + 2.0 * longest);
    list.most_shift = static_cast<Real>(kShifted * island_distance_);
    collision_->update_boxes(positions);
    collision_->find_object_pairs();
    proximities_.run(positions);
    find_islands(list);
    list_pairs(list);
    assign_slots(list);
    find_rooms(list);
    const std::vector<std::uint32_t>& nodes = model_->surface_parts.nodes;
    list.found_at.resize(nodes.size());
    for (std::size_t s = 0; s < nodes.size(); ++s) list.found_at[s] = Vec3<Real>(positions[nodes[s]]);
    list.is_valid = true;
}

// By union of objects that are near each other; islands are numbered in the order of their first objects.
template <class Real>
void DetectContacts<Real>::find_islands(ContactList<Real>& list) {
    const auto count = static_cast<std::uint32_t>(model_->objects.size());
    const std::vector<AxisBox<Real>>& boxes = collision_->bounding_boxes();
    const auto apart = static_cast<Real>(island_distance_);
    object_tree_.update(boxes);
    tbb::parallel_for(std::uint32_t(0), count, [&](std::uint32_t o) {
        AxisBox<Real> box = boxes[o];
        box.min -= apart;
        box.max += apart;
        near_[o].clear();
        object_tree_.for_objects_near(box, [&](std::uint32_t other) {
            if (other != o) near_[o].push_back(other);
        });
        std::sort(near_[o].begin(), near_[o].end());
    });
    std::vector<std::uint32_t> roots(count);
    std::iota(roots.begin(), roots.end(), 0u);
    const auto root = [&](std::uint32_t o) {
        while (roots[o] != o) o = roots[o] = roots[roots[o]];
        return o;
    };
    for (std::uint32_t o = 0; o < count; ++o) {
        for (const std::uint32_t other : near_[o]) {
            const std::uint32_t mine = root(o), theirs = root(other);
            roots[std::max(mine, theirs)] = std::min(mine, theirs);
        }
    }
    list.islands.resize(count);
    list.is_alone.clear();
    for (std::uint32_t o = 0; o < count; ++o) {
        const std::uint32_t first = root(o);
        list.islands[o] = first == o ? static_cast<std::uint32_t>(list.is_alone.size()) : list.islands[first];
        if (first == o) {
            list.is_alone.push_back(1);
        } else {
            list.is_alone[list.islands[o]] = 0;
        }
    }
    list.shifts.assign(list.is_alone.size(), Vec3<Real>(0));
}

// Proximities see edges from both sides.
template <class Real>
void DetectContacts<Real>::list_pairs(ContactList<Real>& list) const {
    const SurfaceParts& parts = model_->surface_parts;
    const std::vector<Proximity<Real>>& found = proximities_.proximities();
    const std::size_t faces_end = proximities_.starts()[parts.nodes.size()];
    list.pairs.clear();
    list.first_edges = 0;
    for (std::size_t p = 0; p < found.size(); ++p) {
        ContactPair pair{};
        pair.first = found[p].first;
        pair.second = found[p].second;
        if (p < faces_end) {
            const Face& face = model_->faces[pair.second];
            pair.nodes = {pair.first, face.a, face.b, face.c};
            pair.first_count = 1;
        } else {
            if (pair.first > pair.second) continue;
            const FaceEdge &edge = parts.edges[pair.first], &other = parts.edges[pair.second];
            pair.nodes = {edge.a, edge.b, other.a, other.b};
            pair.first_count = 2;
        }
        pair.object = object_of_[pair.nodes[0]];
        pair.other = object_of_[pair.nodes[3]];
        const double listed = kListedReach * surface_->reach(pair.object, pair.other);
        if (!(found[p].distance < static_cast<Real>(listed))) continue;
        list.pairs.push_back(pair);
        if (!pair.is_edges()) ++list.first_edges;
    }
}

template <class Real>
void DetectContacts<Real>::assign_slots(ContactList<Real>& list) const {
    const std::vector<std::uint32_t>& places = surface_->places;
    list.row_starts.assign(model_->surface_parts.nodes.size() + 1, 0);
    for (const ContactPair& pair : list.pairs)
        for (const std::uint32_t n : pair.nodes) ++list.row_starts[places[n]];
    std::exclusive_scan(list.row_starts.begin(), list.row_starts.end(), list.row_starts.begin(), 0u);
    std::vector<std::uint32_t> next(list.row_starts.begin(), list.row_starts.end() - 1);
    list.slot_pairs.resize(list.row_starts.back());
    for (std::uint32_t p = 0; p < list.pairs.size(); ++p) {
        for (std::uint32_t k = 0; k < 4; ++k) {
            const std::uint32_t slot = next[places[list.pairs[p].nodes[k]]]++;
            list.pairs[p].slots[k] = slot;
            list.slot_pairs[slot] = 4 * p + k;
        }
    }
}

// What is not listed is farther apart than the pair's listed distance, and, if nothing of a leaf is near any
// other body's leaf, than that and the distance between the leaves' boxes, which have the margin. Each node
// may use its part of both, less the reach.
template <class Real>
void DetectContacts<Real>::find_rooms(ContactList<Real>& list) const {
    const BoxTree& trees = model_->face_trees;
    const std::vector<std::uint32_t>& leaves = trees.levels[0];
    const auto most = static_cast<Real>(kSearched * island_distance_);
    std::vector<Real> distances(leaves.size());
    for_each_index(0, leaves.size(), 64,
                   [&](std::size_t k) { distances[k] = distance_to_others(leaves[k], most); });
    list.rooms.assign(model_->surface_parts.nodes.size(), most);
    for (std::size_t k = 0; k < leaves.size(); ++k) {
        const TreeNode& leaf = trees.nodes[leaves[k]];
        for (std::uint32_t f = leaf.first_item; f < leaf.first_item + leaf.item_count; ++f) {
            const Face& face = model_->faces[f];
            for (const std::uint32_t n : {face.a, face.b, face.c}) {
                Real& room = list.rooms[surface_->places[n]];
                room = std::min(room, distances[k]);
            }
        }
    }
    for (std::size_t s = 0; s < list.rooms.size(); ++s) {
        const double thickness = surface_->thicknesses[object_of_[model_->surface_parts.nodes[s]]];
        list.rooms[s] = static_cast<Real>(kRoom) * list.rooms[s] +
                        static_cast<Real>(2.0 * kRoom * (kListedReach - 1.0) * thickness);
    }
}

// From the box of a leaf to the nearest leaf of another body [m].
template <class Real>
Real DetectContacts<Real>::distance_to_others(std::uint32_t leaf, Real most) const {
    const BoxTree& trees = model_->face_trees;
    const std::vector<AxisBox<Real>>& boxes = collision_->tree_boxes();
    Real least = most * most;
    for (const std::uint32_t other : near_[model_->faces[trees.nodes[leaf].first_item].object]) {
        const std::uint32_t end = trees.nodes[trees.roots[other]].skip;
        for (std::uint32_t n = trees.roots[other]; n < end && least > Real(0);) {
            const Real squared = squared_distance(boxes[leaf], boxes[n]);
            const bool is_near = squared < least;
            if (is_near && trees.nodes[n].item_count > 0) least = squared;
            n = is_near ? n + 1 : trees.nodes[n].skip;
        }
    }
    return std::sqrt(least);
}

template class DetectContacts<float>;
template class DetectContacts<double>;

}  // namespace gelatin::cpu
