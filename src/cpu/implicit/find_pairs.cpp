#include "cpu/implicit/find_pairs.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <utility>

#include "cpu/collision/walk_tree.h"
#include "cpu/contact/nearest_pairs.h"
#include "model/corners.h"
#include "model/for_each_index.h"

namespace gelatin::cpu {
namespace {

constexpr std::size_t kLeavesATask = 16;
// Bodies that are convex at the start and keep this part of all distances do not meet themselves. Nearer
// parts would press from half of their distance at rest on, but so far elements resist more than contacts.
constexpr double kKept = 0.25;

}  // namespace

template <class Real>
FindPairs<Real>::FindPairs(std::shared_ptr<const Model> model, std::shared_ptr<const ContactSurface> surface,
                           bool own)
    : model_(std::move(model)),
      surface_(std::move(surface)),
      own_(own),
      object_of_(objects_of_nodes(*model_)),
      kept_(model_, *surface_),
      owns_(model_->objects.size()),
      rest_boxes_(model_->face_trees.nodes.size()),
      bounding_boxes_(model_->objects.size()),
      motions_(model_->objects.size()),
      object_tree_(static_cast<std::uint32_t>(model_->objects.size())),
      found_((model_->face_trees.levels[0].size() + kLeavesATask - 1) / kLeavesATask) {
    for (Boxes* boxes : {&boxes_, &own_boxes_}) {
        boxes->nodes.resize(model_->node_count());
        boxes->faces.resize(model_->faces.size());
        boxes->edges.resize(model_->surface_parts.edges.size());
        boxes->trees.resize(model_->face_trees.nodes.size());
    }
    for (const std::uint32_t leaf : model_->face_trees.levels[0]) {
        const TreeNode& node = model_->face_trees.nodes[leaf];
        for (std::uint32_t f = node.first_item; f < node.first_item + node.item_count; ++f)
            for (const std::uint32_t n : corners_of(model_->faces[f]))
                rest_boxes_[leaf].add(Vec3<Real>(glm::vec3(model_->positions[n])));
    }
}

// Two boxes meet that are nearer than both slacks and the reach. @param frame a motion that is taken off
template <class Real>
void FindPairs<Real>::update_boxes(std::size_t object, const Vec3<Real>& frame, const Paths<Real>& paths,
                                   Boxes& boxes) const {
    const SurfaceParts& parts = model_->surface_parts;
    const auto margin = BoxMargin<Real>::for_distance(
        2.0 * (static_cast<double>(paths.slacks[object]) + surface_->thicknesses[object]));
    const Range& faces = model_->objects[object].faces;
    const glm::uvec2 first = parts.face_starts[faces.first], end = parts.face_starts[faces.end()];
    for_each_index(Range{first.x, end.x - first.x}, [&](std::uint32_t s) {
        const std::uint32_t n = parts.nodes[s];
        AxisBox<Real> box;
        box.add(Vec3<Real>(paths.from[n]), margin);
        box.add(Vec3<Real>(paths.to[n]) - frame, margin);
        boxes.nodes[n] = box;
    });
    const auto hull = [&](std::initializer_list<std::uint32_t> nodes) {
        AxisBox<Real> box;
        for (const std::uint32_t n : nodes) box.add(boxes.nodes[n]);
        return box;
    };
    for_each_index(faces, [&](std::uint32_t f) {
        const Face& face = model_->faces[f];
        boxes.faces[f] = hull({face.a, face.b, face.c});
    });
    for_each_index(Range{first.y, end.y - first.y}, [&](std::uint32_t e) {
        boxes.edges[e] = hull({parts.edges[e].a, parts.edges[e].b});
    });
    update_tree_boxes<Real>(model_->face_trees, model_->face_trees.roots[object], boxes.faces, boxes.trees);
}

template <class Real>
void FindPairs<Real>::find_own(const Paths<Real>& paths) {
    for (std::uint32_t o = 0; o < model_->body_count(); ++o) {
        Own& own = owns_[o];
        own = {true, {}, {}};
        if (kept_.is_convex(o)) {
            own.lost = kept_.find_lost_blocks(o, static_cast<Real>(kKept), paths.from, paths.to);
            for (std::size_t b = 0; b < own.lost.size(); ++b)
                if (own.lost[b] != 0) own.boxes.push_back(kept_.box_of_block(o, b));
            own.meets_itself = !own.boxes.empty();
        }
        if (!own.meets_itself) continue;
        update_boxes(o, motions_[o], paths, own_boxes_);
    }
}

template <class Real>
bool FindPairs<Real>::keeps_own(std::span<const Vec4<Real>> ends) const {
    if (!own_) return true;
    for (std::uint32_t o = 0; o < model_->body_count(); ++o)
        if (kept_.is_convex(o) && !kept_.others_keep(o, static_cast<Real>(kKept), owns_[o].lost, ends))
            return false;
    return true;
}

template <class Real>
void FindPairs<Real>::begin(const Paths<Real>& paths) {
    for_each_index(0, model_->objects.size(), 1, [&](std::size_t o) {
        if (model_->objects[o].faces.count == 0) return;
        update_boxes(o, Vec3<Real>(0), paths, boxes_);
        bounding_boxes_[o] = boxes_.trees[model_->face_trees.roots[o]];
        const Range& nodes = model_->objects[o].nodes;
        glm::dvec3 sum(0.0);
        for (std::uint32_t n = nodes.first; n < nodes.end(); ++n)
            sum += glm::dvec3(paths.to[n]) - glm::dvec3(paths.from[n]);
        motions_[o] = Vec3<Real>(sum / static_cast<double>(nodes.count));
    });
    object_tree_.update(bounding_boxes_);
}

template <class Real>
Real FindPairs<Real>::fastest_approach() const {
    Real fastest = 0;
    for (std::uint32_t o = 0; o < model_->body_count(); ++o)
        object_tree_.for_objects_near(bounding_boxes_[o], [&](std::uint32_t other) {
            if (other != o)
                fastest = std::max(fastest, glm::length(motions_[other] - motions_[o]) /
                                                static_cast<Real>(surface_->reach(o, other)));
        });
    return fastest;
}

template <class Real>
void FindPairs<Real>::run(const Paths<Real>& paths) {
    if (own_) find_own(paths);

    const std::vector<std::uint32_t>& leaves = model_->face_trees.levels[0];
    tbb::parallel_for(std::size_t(0), found_.size(), [&](std::size_t task) {
        Found& found = found_[task];
        found.of_nodes.clear();
        found.of_edges.clear();
        const std::size_t end = std::min((task + 1) * kLeavesATask, leaves.size());
        for (std::size_t k = task * kLeavesATask; k < end; ++k) search(leaves[k], paths, found);
    });
    pairs_.clear();
    for (const Found& found : found_)
        pairs_.insert(pairs_.end(), found.of_nodes.begin(), found.of_nodes.end());
    for (const Found& found : found_)
        pairs_.insert(pairs_.end(), found.of_edges.begin(), found.of_edges.end());
}

template <class Real>
void FindPairs<Real>::walk(std::uint32_t leaf, std::uint32_t object, const Boxes& boxes, Found& found) const {
    const BoxTree& trees = model_->face_trees;
    const std::vector<glm::uvec2>& starts = model_->surface_parts.face_starts;
    const AxisBox<Real>& box = boxes.trees[leaf];
    const bool is_own = &boxes == &own_boxes_;
    for_leaves_near<Real>(trees, boxes.trees, trees.roots[object], box, [&](std::uint32_t other) {
        if (is_own && is_kept(object, leaf, other)) return;
        const std::uint32_t first = trees.nodes[other].first_item,
                            end = first + trees.nodes[other].item_count;
        for (std::uint32_t f = first; f < end; ++f)
            if (meet(box, boxes.faces[f])) found.faces.push_back({f, boxes.faces[f]});
        for (std::uint32_t e = starts[first].y; e < starts[end].y; ++e)
            if (meet(box, boxes.edges[e])) found.edges.push_back({e, boxes.edges[e]});
    });
}

// Whether the lines between what two leaves have meet no lost tets at the start.
template <class Real>
bool FindPairs<Real>::is_kept(std::uint32_t object, std::uint32_t leaf, std::uint32_t other) const {
    const std::vector<AxisBox<Real>>& lost = owns_[object].boxes;
    if (lost.empty()) return false;
    AxisBox<Real> lines = rest_boxes_[leaf];
    lines.add(rest_boxes_[other]);
    return std::none_of(lost.begin(), lost.end(), [&](const AxisBox<Real>& box) { return meet(box, lines); });
}

template <class Real>
void FindPairs<Real>::search(std::uint32_t leaf, const Paths<Real>& paths, Found& found) const {
    const SurfaceParts& parts = model_->surface_parts;
    const TreeNode& faces = model_->face_trees.nodes[leaf];
    const glm::uvec2 first = parts.face_starts[faces.first_item],
                     end = parts.face_starts[faces.first_item + faces.item_count];
    if (first == end) return;
    const std::uint32_t object = model_->faces[faces.first_item].object;
    std::vector<std::uint32_t> others;
    object_tree_.for_objects_near(boxes_.trees[leaf], [&](std::uint32_t other) {
        if (other == object ? own_ && owns_[object].meets_itself
                            : model_->is_body(object) || model_->is_body(other))
            others.push_back(other);
    });
    std::sort(others.begin(), others.end());
    for (const std::uint32_t other : others) {
        const Boxes& boxes = other == object ? own_boxes_ : boxes_;
        found.faces.clear();
        found.edges.clear();
        walk(leaf, other, boxes, found);
        const auto reach = static_cast<float>(surface_->reach(object, other));
        found.candidates.clear();
        for (std::uint32_t place = first.x; place < end.x; ++place) {
            const std::uint32_t n = parts.nodes[place];
            for (const Near& near : found.faces) {
                const Face& face = model_->faces[near.index];
                if (!meet(boxes.nodes[n], near.box) || has_corner(face, n)) continue;
                found.candidates.push_back(
                    {{n, face.a, face.b, face.c}, {}, n, near.index, object, other, 1, reach});
            }
        }
        keep_near(paths, found, found.of_nodes);
        if (other < object) continue;
        found.candidates.clear();
        for (std::uint32_t e = first.y; e < end.y; ++e) {
            const FaceEdge& edge = parts.edges[e];
            for (const Near& near : found.edges) {
                const FaceEdge& to = parts.edges[near.index];
                if (!meet(boxes.edges[e], near.box)) continue;
                if (other == object && (near.index <= e || share_end(edge, to))) continue;
                found.candidates.push_back(
                    {{edge.a, edge.b, to.a, to.b}, {}, e, near.index, object, other, 2, reach});
            }
        }
        keep_near(paths, found, found.of_edges);
    }
}

// Where a direction separates the two sides at both ends, it does so all the way, as nodes go straight. Here
// with room for both slacks and the reach.
template <class Real>
void FindPairs<Real>::keep_near(const Paths<Real>& paths, const Found& found,
                                std::vector<NearPair<Real>>& kept) const {
    for_measured<Real>(
        found.candidates, paths.from, [&](std::size_t p, const MeasuredPairs<Real>& measured, std::size_t c) {
            const ContactPair& pair = found.candidates[p];
            const Real wanted =
                static_cast<Real>(pair.reach) + paths.slacks[pair.object] + paths.slacks[pair.other];
            const Real gap = measured.gaps[c];
            Vec3<Real> normal(measured.apart[0][c], measured.apart[1][c], measured.apart[2][c]);
            if (gap > Real(0)) normal /= gap;
            if (gap > wanted && separation(pair, normal, paths.to) > wanted) return;
            kept.push_back({pair,
                            normal,
                            {measured.weights[0][c], measured.weights[1][c], measured.weights[2][c],
                             measured.weights[3][c]},
                            gap,
                            measured.rounding[c]});
        });
}

template class FindPairs<float>;
template class FindPairs<double>;

}  // namespace gelatin::cpu
