#include "cpu/contact/near_at_rest.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <limits>
#include <utility>

#include "cpu/collision/walk_tree.h"
#include "cpu/contact/contact_pair.h"
#include "cpu/contact/moment_between.h"
#include "cpu/contact/nearest_pairs.h"
#include "model/corners.h"
#include "model/for_each_index.h"
#include "model/nearest_rotation.h"

namespace gelatin::cpu {
namespace {

template <class Real>
Vec3<Real> size_of(const AxisBox<Real>& box) {
    return box.max - box.min;
}

}  // namespace

template <class Real>
NearAtRest<Real>::NearAtRest(std::shared_ptr<const Model> model)
    : model_(std::move(model)),
      shapes_(model_->objects.size()),
      near_(model_->face_trees.nodes.size()),
      of_nodes_(model_->node_count()),
      of_leaves_(near_.size()) {}

template <class Real>
float NearAtRest<Real>::nearest_gap(std::uint32_t object, const TreeNode& leaf, const TreeNode& other) const {
    const SurfaceParts& parts = model_->surface_parts;
    const auto starts = [&](const TreeNode& node) {
        return std::pair(parts.face_starts[node.first_item],
                         parts.face_starts[node.first_item + node.item_count]);
    };
    const auto [first, end] = starts(leaf);
    const auto [other_first, other_end] = starts(other);
    std::vector<ContactPair> nodes, edges;
    for (std::uint32_t s = first.x; s < end.x; ++s)
        for (std::uint32_t f = other.first_item; f < other.first_item + other.item_count; ++f) {
            const std::uint32_t n = parts.nodes[s];
            const Face& face = model_->faces[f];
            if (!has_corner(face, n))
                nodes.push_back({{n, face.a, face.b, face.c}, n, f, object, object, 1, 0});
        }
    for (std::uint32_t e = first.y; e < end.y; ++e)
        for (std::uint32_t k = other_first.y; k < other_end.y; ++k) {
            const FaceEdge &edge = parts.edges[e], &near = parts.edges[k];
            if (!share_end(edge, near) && k != e)
                edges.push_back({{edge.a, edge.b, near.a, near.b}, e, k, object, object, 2, 0});
        }
    float gap = std::numeric_limits<float>::infinity();
    for (const std::vector<ContactPair>* pairs : {&nodes, &edges})
        for_measured<float>(*pairs, model_->positions,
                            [&](std::size_t, const MeasuredPairs<float>& measured, std::size_t column) {
                                gap = std::min(gap, measured.gaps[column] - measured.rounding[column]);
                            });
    return gap;
}

// Up to the mean size of a leaf.
template <class Real>
void NearAtRest<Real>::add(std::uint32_t object, std::span<const AxisBox<Real>> boxes) {
    const std::vector<TreeNode>& nodes = model_->face_trees.nodes;
    const std::uint32_t root = model_->face_trees.roots[object];
    std::vector<std::uint32_t> leaves;
    Real sizes = 0;
    for (std::uint32_t n = root; n < nodes[root].skip; ++n) {
        if (nodes[n].item_count == 0) continue;
        const Vec3<Real> size = size_of(boxes[n]);
        leaves.push_back(n);
        sizes += std::max(size.x, std::max(size.y, size.z));
    }
    const Real listed = sizes / static_cast<Real>(leaves.size());
    shapes_[object].listed = listed;
    for_each_index(leaves.size(), [&](std::size_t l) {
        const std::uint32_t leaf = leaves[l];
        AxisBox<Real> box = boxes[leaf];
        box.min -= Vec3<Real>(listed);
        box.max += Vec3<Real>(listed);
        for (std::uint32_t n = root; n < nodes[root].skip;) {
            const bool is_near = meet(box, boxes[n]);
            if (is_near && nodes[n].item_count > 0) {
                const float gap = nearest_gap(object, nodes[leaf], nodes[n]);
                if (static_cast<Real>(gap) <= listed) near_[leaf].push_back({n, gap});
            }
            n = is_near ? n + 1 : nodes[n].skip;
        }
        std::sort(near_[leaf].begin(), near_[leaf].end(), [](const Near& a, const Near& b) {
            return std::pair(a.gap, a.leaf) < std::pair(b.gap, b.leaf);
        });
    });
}

template <class Real>
void NearAtRest<Real>::begin(std::uint32_t object, std::span<const Vec4<Real>> from,
                             std::span<const Vec4<Real>> to, Real within) {
    Shape& shape = shapes_[object];
    shape.is_enough = false;
    if (!(shape.listed > Real(0))) return;
    const Range& nodes = model_->objects[object].nodes;
    for (std::uint32_t n = nodes.first; n < nodes.end(); ++n) of_nodes_[n] = {};
    const auto at_start = [&](std::uint32_t n) { return glm::dvec3(glm::vec3(model_->positions[n])); };
    glm::dmat3 rotations[2];
    AxisBox<Real> all;
    for (const std::size_t end : {0, 1}) {
        const std::span<const Vec4<Real>> positions = end == 0 ? from : to;
        const auto now = [&](std::uint32_t n) { return glm::dvec3(positions[n]); };
        const MomentBetween between = moment_between(nodes, at_start, now);
        rotations[end] = nearest_rotation(between.moment);
        const glm::dmat3 back = glm::transpose(rotations[end]);
        for (std::uint32_t n = nodes.first; n < nodes.end(); ++n)
            of_nodes_[n].add(
                Vec3<Real>(back * (now(n) - between.middle_b) - (at_start(n) - between.middle_a)));
    }
    double farthest = 0.0;  // from the origin: by it positions are rounded
    for (std::uint32_t n = nodes.first; n < nodes.end(); ++n) {
        all.add(of_nodes_[n]);
        farthest = std::max(farthest, static_cast<double>(glm::length(Vec3<Real>(from[n]))));
    }
    constexpr double kRounding = 16.0 * std::numeric_limits<Real>::epsilon();
    const glm::dmat3 turn = glm::transpose(rotations[0]) * rotations[1];
    const double cosine = 0.5 * (turn[0][0] + turn[1][1] + turn[2][2] - 1.0);
    shape.within = within + static_cast<Real>(kRounding * farthest);
    shape.cosine = static_cast<Real>(std::sqrt(std::max(0.5 * (1.0 + cosine), 0.0)));
    shape.most = glm::length(size_of(all));
    shape.is_enough = shape.are_apart(shape.listed, shape.most);
    if (!shape.is_enough) return;
    const std::uint32_t root = model_->face_trees.roots[object];
    for (std::uint32_t n = root; n < model_->face_trees.nodes[root].skip; ++n) {
        const TreeNode& leaf = model_->face_trees.nodes[n];
        of_leaves_[n] = {};
        for (std::uint32_t f = leaf.first_item; f < leaf.first_item + leaf.item_count; ++f)
            for (const std::uint32_t corner : corners_of(model_->faces[f]))
                of_leaves_[n].add(of_nodes_[corner]);
    }
}

template <class Real>
void NearAtRest<Real>::find(std::uint32_t object, std::uint32_t leaf,
                            std::vector<std::uint32_t>& leaves) const {
    const Shape& shape = shapes_[object];
    leaves.clear();
    for (const Near& near : near_[leaf]) {
        const auto gap = static_cast<Real>(near.gap);
        if (shape.are_apart(gap, shape.most)) break;
        AxisBox<Real> both = of_leaves_[leaf];
        both.add(of_leaves_[near.leaf]);
        if (!shape.are_apart(gap, glm::length(size_of(both)))) leaves.push_back(near.leaf);
    }
    std::sort(leaves.begin(), leaves.end());
}

template class NearAtRest<float>;
template class NearAtRest<double>;

}  // namespace gelatin::cpu
