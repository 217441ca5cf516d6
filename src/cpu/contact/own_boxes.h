#pragma once

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "cpu/collision/axis_box.h"
#include "cpu/collision/walk_tree.h"
#include "cpu/contact/contact_list.h"
#include "cpu/contact/near_boxes.h"
#include "model/corners.h"
#include "model/for_each_index.h"
#include "model/model.h"

namespace gelatin::cpu {

/// Boxes of what single bodies' surfaces are made of, and which of one body meet: nodes with faces, and edges
/// with edges, without a node in common.
template <class Real>
class OwnBoxes {
public:
    /// What is near some leaves: all, and what has changed.
    enum Which { all, changed };
    struct Near {
        std::array<NearBoxes<Real>, 2> faces, edges;
    };

    explicit OwnBoxes(std::shared_ptr<const Model> model);

    /// Of a body: places in the lowest level of the trees, in the order of faces.
    Range leaves_of(std::uint32_t object) const {
        const Range& faces = model_->objects[object].faces;
        const std::uint32_t first = leaf_of_face(faces.first);
        return {first, leaf_of_face(faces.end() - 1) + 1 - first};
    }
    std::uint32_t leaf_of_face(std::uint32_t face) const { return leaf_of_faces_[face]; }
    std::uint32_t leaf_of(const TreeNode& node) const { return leaf_of_faces_[node.first_item]; }
    const TreeNode& node_of(std::uint32_t leaf) const {
        return model_->face_trees.nodes[model_->face_trees.levels[0][leaf]];
    }

    /// Writes the boxes of a body. @param add_node(node, box) adds what of a node is to be in a box
    template <class AddNode>
    void update(std::uint32_t object, const AddNode& add_node);

    /// near(leaf) for those whose boxes meet that of a leaf of the same body.
    template <class Use>
    void for_leaves_near_leaf(std::uint32_t object, std::uint32_t leaf, const Use& use) const {
        const BoxTree& trees = model_->face_trees;
        for_leaves_near<Real>(trees, tree_boxes_, trees.roots[object], tree_boxes_[trees.levels[0][leaf]],
                              [&](std::uint32_t node) { use(leaf_of(trees.nodes[node])); });
    }

    /// Finds what is near leaves beside each other. @param has_changed(node)
    /// @param counts(leaf) whether what is in one is looked for
    template <class HasChanged, class Counts>
    void find_near(std::uint32_t object, std::span<const std::uint32_t> leaves, const HasChanged& has_changed,
                   const Counts& counts, Near& near) const;
    /// use(pair) for what of a leaf meets what is near it: what has changed with all, the rest with what has.
    /// Each pair once if this is done for all leaves. Pairs have no slots, and no reach.
    template <class HasChanged, class Use>
    void for_node_pairs(std::uint32_t leaf, const HasChanged& has_changed, Near& near, const Use& use) const;
    template <class HasChanged, class Use>
    void for_edge_pairs(std::uint32_t leaf, const HasChanged& has_changed, Near& near, const Use& use) const;
    /// use(face, other) for the faces of a leaf and all that are near.
    template <class Use>
    void for_face_pairs(std::uint32_t leaf, Near& near, const Use& use) const;

private:
    std::shared_ptr<const Model> model_;
    std::vector<std::uint32_t> leaf_of_faces_;
    std::vector<AxisBox<Real>> node_boxes_, edge_boxes_, face_boxes_, tree_boxes_;
};

/// Leaves beside each other, whose surroundings are looked for at once: visit(walk, state) for each such
/// walk, on several threads, each of which has a state of its own.
template <class State, class Visit>
void for_walks(std::span<const std::uint32_t> leaves, const Visit& visit) {
    constexpr std::size_t kLeavesAWalk = 8, kLeavesATask = 32;
    tbb::parallel_for(std::size_t(0), (leaves.size() + kLeavesATask - 1) / kLeavesATask,
                      [&](std::size_t task) {
                          State state;
                          const std::size_t end = std::min((task + 1) * kLeavesATask, leaves.size());
                          for (std::size_t first = task * kLeavesATask; first < end;) {
                              std::size_t count = 1;  // others may be far apart
                              while (count < kLeavesAWalk && first + count < end &&
                                     leaves[first + count] == leaves[first] + count)
                                  ++count;
                              visit(leaves.subspan(first, count), state);
                              first += count;
                          }
                      });
}

template <class Real>
OwnBoxes<Real>::OwnBoxes(std::shared_ptr<const Model> model)
    : model_(std::move(model)),
      leaf_of_faces_(model_->faces.size()),
      node_boxes_(model_->surface_parts.nodes.size()),
      edge_boxes_(model_->surface_parts.edges.size()),
      face_boxes_(model_->faces.size()),
      tree_boxes_(model_->face_trees.nodes.size()) {
    const std::vector<std::uint32_t>& leaves = model_->face_trees.levels[0];
    for (std::uint32_t k = 0; k < leaves.size(); ++k) {
        const TreeNode& leaf = model_->face_trees.nodes[leaves[k]];
        std::fill_n(leaf_of_faces_.begin() + leaf.first_item, leaf.item_count, k);
    }
}

template <class Real>
template <class AddNode>
void OwnBoxes<Real>::update(std::uint32_t object, const AddNode& add_node) {
    const Range& faces = model_->objects[object].faces;
    const SurfaceParts& parts = model_->surface_parts;
    const auto box_of = [&](const auto& nodes) {
        AxisBox<Real> box;
        for (const std::uint32_t n : nodes) add_node(n, box);
        return box;
    };
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

template <class Real>
template <class HasChanged, class Counts>
void OwnBoxes<Real>::find_near(std::uint32_t object, std::span<const std::uint32_t> leaves,
                               const HasChanged& has_changed, const Counts& counts, Near& near) const {
    const BoxTree& trees = model_->face_trees;
    const SurfaceParts& parts = model_->surface_parts;
    AxisBox<Real> around;
    for (const std::uint32_t leaf : leaves) around.add(tree_boxes_[trees.levels[0][leaf]]);
    const std::uint32_t first_edge = parts.face_starts[node_of(leaves[0]).first_item].y;
    for (const Which which : {all, changed}) {
        near.faces[which].clear();
        near.edges[which].clear();
    }
    const auto add = [&](std::array<NearBoxes<Real>, 2>& found, std::uint32_t index, const AxisBox<Real>& box,
                         bool changes) {
        if (!meet(around, box)) return;
        found[all].add(index, box);
        if (changes) found[changed].add(index, box);
    };
    for_leaves_near<Real>(trees, tree_boxes_, trees.roots[object], around, [&](std::uint32_t node) {
        if (!counts(leaf_of(trees.nodes[node]))) return;
        const std::uint32_t first = trees.nodes[node].first_item, end = first + trees.nodes[node].item_count;
        for (std::uint32_t f = first; f < end; ++f) {
            const Face& face = model_->faces[f];
            add(near.faces, f, face_boxes_[f],
                has_changed(face.a) || has_changed(face.b) || has_changed(face.c));
        }
        for (std::uint32_t e = std::max(parts.face_starts[first].y, first_edge + 1);
             e < parts.face_starts[end].y; ++e)
            add(near.edges, e, edge_boxes_[e],
                has_changed(parts.edges[e].a) || has_changed(parts.edges[e].b));
    });
}

template <class Real>
template <class HasChanged, class Use>
void OwnBoxes<Real>::for_node_pairs(std::uint32_t leaf, const HasChanged& has_changed, Near& near,
                                    const Use& use) const {
    const SurfaceParts& parts = model_->surface_parts;
    const TreeNode& faces = node_of(leaf);
    const std::uint32_t object = model_->faces[faces.first_item].object;
    const std::uint32_t end = parts.face_starts[faces.first_item + faces.item_count].x;
    for (std::uint32_t s = parts.face_starts[faces.first_item].x; s < end; ++s) {
        const std::uint32_t node = parts.nodes[s];
        near.faces[has_changed(node) ? all : changed].for_meeting(node_boxes_[s], [&](std::uint32_t f) {
            const Face& face = model_->faces[f];
            if (!has_corner(face, node))
                use(ContactPair{{node, face.a, face.b, face.c}, {}, node, f, object, object, 1, 0.0f});
        });
    }
}

template <class Real>
template <class HasChanged, class Use>
void OwnBoxes<Real>::for_edge_pairs(std::uint32_t leaf, const HasChanged& has_changed, Near& near,
                                    const Use& use) const {
    const SurfaceParts& parts = model_->surface_parts;
    const TreeNode& faces = node_of(leaf);
    const std::uint32_t object = model_->faces[faces.first_item].object;
    const std::uint32_t end = parts.face_starts[faces.first_item + faces.item_count].y;
    for (std::uint32_t e = parts.face_starts[faces.first_item].y; e < end; ++e) {
        const FaceEdge& edge = parts.edges[e];
        const Which which = has_changed(edge.a) || has_changed(edge.b) ? all : changed;
        near.edges[which].for_meeting(edge_boxes_[e], [&](std::uint32_t other) {
            const FaceEdge& second = parts.edges[other];
            if (other > e && !share_end(edge, second))
                use(ContactPair{{edge.a, edge.b, second.a, second.b}, {}, e, other, object, object, 2, 0.0f});
        });
    }
}

template <class Real>
template <class Use>
void OwnBoxes<Real>::for_face_pairs(std::uint32_t leaf, Near& near, const Use& use) const {
    const TreeNode& faces = node_of(leaf);
    for (std::uint32_t f = faces.first_item; f < faces.first_item + faces.item_count; ++f) {
        near.faces[all].for_meeting(face_boxes_[f], [&](std::uint32_t other) {
            if (other > f && !share_corner(model_->faces[f], model_->faces[other])) use(f, other);
        });
    }
}

}  // namespace gelatin::cpu
