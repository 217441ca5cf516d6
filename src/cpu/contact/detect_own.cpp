#include "cpu/contact/detect_own.h"

#include <algorithm>
#include <array>
#include <numeric>
#include <utility>

#include "cpu/collision/walk_tree.h"
#include "cpu/contact/lower_to.h"
#include "cpu/contact/near_objects.h"
#include "model/corners.h"
#include "model/for_each_index.h"

namespace gelatin::cpu {
namespace {

// How far others are looked for from a node, over the longest edge of its faces, and at least over the
// distance up to which pairs are listed: the farther, the larger rooms can be, and the more there is to
// measure.
constexpr double kSearchedOwn = 0.55, kLeastSearchedOwn = 1.1;
// Of what is nearer than the distance up to which pairs are listed, only that is which is nearer than this
// times its gap at rest, or than this times that distance.
constexpr double kNearer = 0.6, kAlways = 0.4;
// Cells of the lattice of a body's map, over the body's thickness, which is a twentieth of an edge.
constexpr double kCell = 80.0;

}  // namespace

template <class Real>
DetectOwn<Real>::DetectOwn(std::shared_ptr<const Model> model, std::shared_ptr<const ContactSurface> surface)
    : model_(std::move(model)),
      surface_(std::move(surface)),
      found_at_(model_->node_count()),
      boxes_(model_),
      searched_(model_->surface_parts.nodes.size()),
      apart_(model_->surface_parts.nodes.size()),
      has_changed_(model_->surface_parts.nodes.size()) {
    restart();
}

template <class Real>
void DetectOwn<Real>::restart() {
    found_.assign(model_->face_trees.levels[0].size(), {});
}

template <class Real>
void DetectOwn<Real>::forget(std::uint32_t object) {
    const Range leaves = boxes_.leaves_of(object);
    std::fill_n(found_.begin() + leaves.first, leaves.count, Found{});
}

template <class Real>
double DetectOwn<Real>::listed(std::uint32_t object) const {
    return 2.0 * kListedReach * surface_->thicknesses[object];
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
    for (std::uint32_t s = places.first; s < places.end(); ++s)
        apart_[s] = searched_[s] = search_distance(object, s, rooms);
    std::fill_n(has_changed_.begin() + places.first, places.count, std::uint8_t(1));
    update_boxes(object, rooms);
    const Range range = boxes_.leaves_of(object);
    std::vector<std::uint32_t> leaves(range.count);
    std::iota(leaves.begin(), leaves.end(), range.first);
    search(object, leaves, rooms);
}

// No nearer than what may have to be listed. Where faces are small, deviations from a smooth motion are, too.
template <class Real>
Real DetectOwn<Real>::search_distance(std::uint32_t object, std::uint32_t place,
                                      const OwnRooms<Real>& rooms) const {
    const Real least = static_cast<Real>(kLeastSearchedOwn * listed(object));
    return std::clamp(static_cast<Real>(kSearchedOwn) * rooms.longest_edge_at(place), least,
                      std::max(least, rooms.most_apart(object)));
}

// Leaves with faces that have these nodes, and all that is near them.
template <class Real>
bool DetectOwn<Real>::run_again(std::uint32_t object, std::span<const std::uint32_t> places,
                                std::span<const Vec4<Real>> positions, OwnRooms<Real>& rooms) {
    if (!rooms.find_again(object, places, positions)) return false;
    const Range& own = rooms.places(object);
    std::fill_n(has_changed_.begin() + own.first, own.count, std::uint8_t(0));
    for (const std::uint32_t s : places) {
        apart_[s] = searched_[s] = search_distance(object, s, rooms);
        has_changed_[s] = 1;
    }
    update_boxes(object, rooms);
    const Range range = boxes_.leaves_of(object);
    std::vector<std::uint8_t> changes(range.count), is_near(range.count);
    const NodeFaces& around = model_->node_faces;
    for (const std::uint32_t s : places) {
        const std::uint32_t node = model_->surface_parts.nodes[s];
        for (std::uint32_t k = around.starts[node]; k < around.starts[node + 1]; ++k)
            changes[boxes_.leaf_of_face(around.faces[k]) - range.first] = 1;
    }
    for (std::uint32_t k = 0; k < range.count; ++k) {
        if (changes[k] == 0) continue;
        boxes_.for_leaves_near_leaf(object, range.first + k,
                                    [&](std::uint32_t leaf) { is_near[leaf - range.first] = 1; });
    }
    std::vector<std::uint32_t> leaves;
    for (std::uint32_t k = 0; k < range.count; ++k)
        if (is_near[k] != 0) leaves.push_back(range.first + k);
    search(object, leaves, rooms);
    return true;
}

// @param leaves among all, in the order of faces
template <class Real>
void DetectOwn<Real>::search(std::uint32_t object, std::span<const std::uint32_t> leaves,
                             OwnRooms<Real>& rooms) {
    const auto has_changed = [&](std::uint32_t n) { return this->has_changed(n); };
    const auto all = [](std::uint32_t) { return true; };
    for_walks<Search>(leaves, [&](std::span<const std::uint32_t> walk, Search& search) {
        boxes_.find_near(object, walk, has_changed, all, search.around);
        for (const std::uint32_t leaf : walk)
            search_leaf(leaf, static_cast<Real>(listed(object)), search, found_[leaf]);
    });
    const Range& places = rooms.places(object);
    for (std::uint32_t s = places.first; s < places.end(); ++s) rooms.set_apart(s, apart_[s]);
    rooms.make_rooms(object);
}

template <class Real>
void DetectOwn<Real>::update_boxes(std::uint32_t object, const OwnRooms<Real>& rooms) {
    const Range& places = rooms.places(object);
    for (std::uint32_t s = places.first; s < places.end(); ++s)
        found_at_[model_->surface_parts.nodes[s]] = Vec4<Real>(rooms.offset(s), Real(0));
    boxes_.update(object, [&](std::uint32_t n, AxisBox<Real>& box) {
        box.add(Vec3<Real>(found_at_[n]),
                BoxMargin<Real>::for_distance(static_cast<double>(searched_[surface_->places[n]])));
    });
}

// The nodes and edges of a leaf together.
template <class Real>
void DetectOwn<Real>::search_leaf(std::uint32_t leaf, Real listed, Search& search, Found& found) {
    const auto has_changed = [&](std::uint32_t n) { return this->has_changed(n); };
    const auto wait = [&](const ContactPair& pair) { search.waiting.push_back(pair); };
    forget_changed(found.of_nodes);
    boxes_.for_node_pairs(leaf, has_changed, search.around, wait);
    keep_near(search, listed, found.of_nodes);
    forget_changed(found.of_edges);
    boxes_.for_edge_pairs(leaf, has_changed, search.around, wait);
    keep_near(search, listed, found.of_edges);
}

// Those with nodes that have changed, which are looked for again.
template <class Real>
void DetectOwn<Real>::forget_changed(std::vector<ContactPair>& pairs) const {
    std::erase_if(pairs, [&](const ContactPair& pair) {
        return std::any_of(pair.nodes.begin(), pair.nodes.end(),
                           [&](std::uint32_t n) { return has_changed(n); });
    });
}

// Others tell their nodes how far apart they are.
template <class Real>
void DetectOwn<Real>::keep_near(Search& search, Real listed, std::vector<ContactPair>& kept) {
    search.near.clear();
    search.gaps.clear();
    const auto keep = [&](std::size_t p, const auto& measured, std::size_t column) {
        const Real gap = measured.gaps[column];
        if (gap > listed) {
            tell_apart(search.waiting[p], gap);
            return;
        }
        search.near.push_back(search.waiting[p]);
        search.gaps.push_back(gap);
    };
    for_measured<Real>(search.waiting, found_at_, keep);
    search.waiting.clear();
    leave_out_resting(search.gaps, static_cast<Real>(kAlways) * listed, search.near);
    const bool is_mixed = !kept.empty();
    kept.insert(kept.end(), search.near.begin(), search.near.end());
    if (is_mixed) sort(kept);
}

template <class Real>
void DetectOwn<Real>::sort(std::vector<ContactPair>& pairs) const {
    std::sort(pairs.begin(), pairs.end(), [&](const ContactPair& a, const ContactPair& b) {
        return a.rank(surface_->places) < b.rank(surface_->places);
    });
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
