#include "cpu/proximity/find_proximities.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "cpu/collision/walk_tree.h"
#include "model/corners.h"

namespace gelatin::cpu {
namespace {

constexpr std::size_t kLeavesATask = 16;
constexpr std::uint32_t kEdgesATask = 2048;

template <class Real>
Proximity<Real> make_proximity(std::uint32_t first, std::uint32_t second, const EdgeToEdge<Real>& nearest) {
    const Real s = nearest.fraction, t = nearest.other_fraction;
    return {first, second, std::sqrt(nearest.squared_distance), nearest.apart, {1 - s, s, 1 - t, t}};
}

// The same as seen from the other edge.
template <class Real>
Proximity<Real> mirrored(const Proximity<Real>& p) {
    return {p.second, p.first, p.distance, -p.apart, {p.weights.z, p.weights.w, p.weights.x, p.weights.y}};
}

}  // namespace

template <class Real>
FindProximities<Real>::FindProximities(std::shared_ptr<const Model> model, const Collision<Real>& collision,
                                       double radius, bool own)
    : model_(std::move(model)),
      collision_(collision),
      margin_(BoxMargin<Real>::for_distance(radius)),
      squared_radius_(static_cast<Real>(radius) * static_cast<Real>(radius)),
      own_(own),
      edge_boxes_(model_->surface_parts.edges.size()),
      found_((model_->face_trees.levels[0].size() + kLeavesATask - 1) / kLeavesATask),
      starts_(model_->surface_parts.nodes.size() + model_->surface_parts.edges.size() + 1) {}

template <class Real>
void FindProximities<Real>::run(std::span<const Vec4<Real>> positions) {
    const SurfaceParts& parts = model_->surface_parts;
    const auto edges = static_cast<std::uint32_t>(parts.edges.size());
    tbb::parallel_for(tbb::blocked_range<std::uint32_t>(0, edges, kEdgesATask), [&](const auto& range) {
        for (std::uint32_t e = range.begin(); e < range.end(); ++e) {
            AxisBox<Real> box;
            for (const std::uint32_t n : {parts.edges[e].a, parts.edges[e].b})
                box.add(Vec3<Real>(positions[n]), margin_);
            edge_boxes_[e] = box;
        }
    });
    std::fill(starts_.begin(), starts_.end(), 0u);
    const std::vector<std::uint32_t>& leaves = model_->face_trees.levels[0];  // in the order of their faces
    tbb::parallel_for(std::size_t(0), found_.size(), [&](std::size_t task) {
        found_[task].node_face.clear();
        found_[task].edge_edge.clear();
        const std::size_t end = std::min((task + 1) * kLeavesATask, leaves.size());
        for (std::size_t k = task * kLeavesATask; k < end; ++k) search(leaves[k], positions, found_[task]);
    });
    collect();
}

template <class Real>
void FindProximities<Real>::search(std::uint32_t leaf, std::span<const Vec4<Real>> positions, Found& found) {
    const TreeNode& faces = model_->face_trees.nodes[leaf];
    const std::vector<glm::uvec2>& face_starts = model_->surface_parts.face_starts;
    const glm::uvec2 first = face_starts[faces.first_item],
                     end = face_starts[faces.first_item + faces.item_count];
    if (first == end) return;
    find_near(leaf, found);
    for (std::uint32_t place = first.x; place < end.x; ++place) test_node(place, positions, found);
    for (std::uint32_t edge = first.y; edge < end.y; ++edge) test_edge(edge, positions, found);
}

// Objects in ascending order, the own one among them. So leaves, and what is in them, are ascending too.
template <class Real>
void FindProximities<Real>::find_near(std::uint32_t leaf, Found& found) const {
    const std::uint32_t object = model_->faces[model_->face_trees.nodes[leaf].first_item].object;
    found.faces.clear();
    found.edges.clear();
    bool own_is_due = own_;
    const Range row = collision_.row(object);
    for (std::uint32_t p = row.first; p < row.end(); ++p) {
        const std::uint32_t other = collision_.pairs()[p].other;
        if (own_is_due && other > object) {
            walk(leaf, object, found);
            own_is_due = false;
        }
        walk(leaf, other, found);
    }
    if (own_is_due) walk(leaf, object, found);
}

template <class Real>
void FindProximities<Real>::walk(std::uint32_t leaf, std::uint32_t object, Found& found) const {
    const BoxTree& trees = model_->face_trees;
    const std::vector<glm::uvec2>& face_starts = model_->surface_parts.face_starts;
    const AxisBox<Real>& box = collision_.tree_boxes()[leaf];
    const auto keep = [&](std::uint32_t index, const AxisBox<Real>& other, std::vector<Near>& near) {
        if (meet(box, other)) near.push_back({index, other});
    };
    for_leaves_near<Real>(trees, collision_.tree_boxes(), trees.roots[object], box, [&](std::uint32_t other) {
        const std::uint32_t first = trees.nodes[other].first_item,
                            end = first + trees.nodes[other].item_count;
        for (std::uint32_t f = first; f < end; ++f) keep(f, collision_.face_boxes()[f], found.faces);
        for (std::uint32_t e = face_starts[first].y; e < face_starts[end].y; ++e)
            keep(e, edge_boxes_[e], found.edges);
    });
}

template <class Real>
void FindProximities<Real>::test_node(std::uint32_t place, std::span<const Vec4<Real>> positions,
                                      Found& found) {
    const std::uint32_t node = model_->surface_parts.nodes[place];
    const Vec3<Real> p(positions[node]);
    AxisBox<Real> box;
    box.add(p, margin_);
    for (const Near& near : found.faces) {
        if (!meet(box, near.box)) continue;
        const Face& face = model_->faces[near.index];
        if (has_corner(face, node)) continue;
        const NodeToFace<Real> nearest = nearest_points<Real>(
            p, {Vec3<Real>(positions[face.a]), Vec3<Real>(positions[face.b]), Vec3<Real>(positions[face.c])});
        if (!(nearest.squared_distance < squared_radius_)) continue;
        found.node_face.push_back({node, near.index, std::sqrt(nearest.squared_distance), nearest.apart,
                                   Vec4<Real>(nearest.weights, 0)});
        ++starts_[place];
    }
}

template <class Real>
void FindProximities<Real>::test_edge(std::uint32_t edge, std::span<const Vec4<Real>> positions,
                                      Found& found) {
    const SurfaceParts& parts = model_->surface_parts;
    const AxisBox<Real>& box = edge_boxes_[edge];
    const auto ends = [&](std::uint32_t e) {
        return std::array{Vec3<Real>(positions[parts.edges[e].a]), Vec3<Real>(positions[parts.edges[e].b])};
    };
    for (const Near& near : found.edges) {
        if (!meet(box, near.box) || share_end(parts.edges[edge], parts.edges[near.index])) continue;
        // In a fixed order, so that both edges get the same result.
        const auto [first, second] = std::minmax(edge, near.index);
        const EdgeToEdge<Real> nearest = nearest_points<Real>(ends(first), ends(second));
        if (!(nearest.squared_distance < squared_radius_)) continue;
        const Proximity<Real> proximity = make_proximity(first, second, nearest);
        found.edge_edge.push_back(edge == first ? proximity : mirrored(proximity));
        ++starts_[parts.nodes.size() + edge];
    }
}

// Leaves, and so nodes and edges, are in order from task to task.
template <class Real>
void FindProximities<Real>::collect() {
    std::exclusive_scan(starts_.begin(), starts_.end(), starts_.begin(), 0u);
    proximities_.resize(starts_.back());
    auto place = proximities_.begin();
    for (const Found& found : found_)
        place = std::copy(found.node_face.begin(), found.node_face.end(), place);
    for (const Found& found : found_)
        place = std::copy(found.edge_edge.begin(), found.edge_edge.end(), place);
}

template <class Real>
ProximityMeasure FindProximities<Real>::measure() const {
    ProximityMeasure measure;
    measure.node_face = starts_[model_->surface_parts.nodes.size()];
    measure.edge_edge = starts_.back() - measure.node_face;
    for (const Proximity<Real>& p : proximities_)
        measure.nearest = std::min(measure.nearest, static_cast<double>(p.distance));
    return measure;
}

template class FindProximities<float>;
template class FindProximities<double>;

}  // namespace gelatin::cpu
