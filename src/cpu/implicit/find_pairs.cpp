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

// Of subtrees that are searched at once.
constexpr std::uint32_t kMostNodes = 32;

template <class Real>
AxisBox<Real> swept(AxisBox<Real> box, const Vec3<Real>& motion) {
    box.min += glm::min(motion, Vec3<Real>(0));
    box.max += glm::max(motion, Vec3<Real>(0));
    return box;
}

// Of what goes on by more than half of its gap: the direction where it is nearest on this way. What passes an
// edge or a corner meets it beside, and not ahead. The second side goes beside the first as its nearest point
// does.
template <class Real>
void look_beside_way(const Paths<Real>& paths, NearPair<Real>& near) {
    const ContactPair& pair = near.pair;
    Vec3<Real> way(0);
    std::array<Vec4<Real>, 4> places{};
    for (std::size_t k = 0; k < 4; ++k) {
        const Real w = near.weights[static_cast<int>(k)];
        way += (pair.side_of(k) == 0 ? -w : w) * paths.step * Vec3<Real>(paths.velocities[pair.nodes[k]]);
        places[k] = paths.from[pair.nodes[k]];
    }
    const Vec4<Real>& w = near.weights;
    if (!pair.is_edges() && std::min({w.y, w.z, w.w}) > static_cast<Real>(tuning::kHardly)) return;
    if (!(Real(4) * glm::dot(way, way) > near.gap * near.gap) || !(glm::dot(way, near.normal) < Real(0)))
        return;
    ContactPair local = pair;
    local.nodes = {0, 1, 2, 3};
    const auto apart_at = [&](Real time) {
        std::array<Vec4<Real>, 4> there = places;
        for (std::size_t k = pair.first_count; k < 4; ++k) there[k] += Vec4<Real>(time * way, 0);
        MeasuredPairs<Real> measured;
        measure_pairs({&local, 1}, there, measured);
        return Vec3<Real>(measured.apart[0][0], measured.apart[1][0], measured.apart[2][0]);
    };
    // The distance of convex sides is convex in time.
    Real time = 1, step = 1;
    Vec3<Real> apart = apart_at(time);
    for (std::uint32_t k = 0; k < 5 && (k > 0 || glm::dot(apart, way) > Real(0)); ++k) {
        step *= Real(0.5);
        time += glm::dot(apart, way) > Real(0) ? -step : step;
        apart = apart_at(time);
    }
    if (time < Real(1)) apart -= glm::dot(apart, way) / glm::dot(way, way) * way;
    const auto least = static_cast<Real>(tuning::kLeastOfReach) * static_cast<Real>(pair.reach);
    if (!(glm::length(apart) > least)) return;
    const Vec3<Real> normal = glm::normalize(apart);
    const Real gap = separation(pair, normal, paths.from);
    if (gap > least) near = {pair, normal, near.weights, gap, rounding_along(normal, pair, paths.from)};
}

}  // namespace

template <class Real>
FindPairs<Real>::FindPairs(std::shared_ptr<const Model> model, std::shared_ptr<const ContactSurface> surface,
                           bool own)
    : model_(std::move(model)),
      surface_(std::move(surface)),
      own_(own),
      kept_(model_, *surface_),
      near_at_rest_(model_),
      owns_(model_->objects.size()),
      rest_boxes_(model_->face_trees.nodes.size()),
      is_still_(model_->objects.size()),
      is_changed_(model_->node_count()),
      is_changed_face_(model_->faces.size()),
      has_changed_(model_->objects.size()),
      bounding_boxes_(model_->objects.size()),
      motions_(model_->objects.size()),
      object_tree_(static_cast<std::uint32_t>(model_->objects.size())) {
    boxes_.nodes.resize(model_->node_count());
    boxes_.edges.resize(model_->surface_parts.edges.size());
    boxes_.edge_columns = BoxColumns<Real>(boxes_.edges.size());
    boxes_.face_columns = BoxColumns<Real>(model_->faces.size());
    for (auto* faces : {&boxes_.faces, &boxes_.changed_faces}) faces->resize(model_->faces.size());
    for (auto* trees : {&boxes_.trees, &boxes_.changed}) trees->resize(model_->face_trees.nodes.size());
    std::vector<AxisBox<Real>> faces(model_->faces.size());
    for (std::size_t f = 0; f < faces.size(); ++f)
        for (const std::uint32_t n : corners_of(model_->faces[f]))
            faces[f].add(Vec3<Real>(glm::vec3(model_->positions[n])));
    const BoxTree& trees = model_->face_trees;
    for (std::uint32_t o = 0; o < model_->objects.size(); ++o) {
        if (model_->objects[o].faces.count == 0) continue;
        const std::uint32_t root = trees.roots[o], end = trees.nodes[root].skip;
        update_tree_boxes<Real>(trees, root, faces, rest_boxes_);
        if (own_ && model_->is_body(o) && !model_->objects[o].is_rigid && !kept_.is_convex(o))
            near_at_rest_.add(o, rest_boxes_);
        for (std::uint32_t n = root; n < end;) {
            const bool is_small = trees.nodes[n].skip - n <= kMostNodes;
            if (is_small) subtrees_.push_back({o, n});
            n = is_small ? trees.nodes[n].skip : n + 1;
        }
    }
    found_.resize(subtrees_.size());
}

// Two boxes meet that are nearer than both slacks and the reach. They are those of an object that stays where
// it is.
template <class Real>
void FindPairs<Real>::update_boxes(std::size_t object, const Paths<Real>& paths) {
    const Vec3<Real>& frame = motions_[object];
    const SurfaceParts& parts = model_->surface_parts;
    const auto margin = BoxMargin<Real>::for_distance(
        2.0 * static_cast<double>(paths.nearness + paths.slack) * surface_->thicknesses[object]);
    const Range& faces = model_->objects[object].faces;
    const glm::uvec2 first = parts.face_starts[faces.first], end = parts.face_starts[faces.end()];
    for_each_index(Range{first.x, end.x - first.x}, [&](std::uint32_t s) {
        const std::uint32_t n = parts.nodes[s];
        AxisBox<Real> box;
        box.add(Vec3<Real>(paths.from[n]), margin);
        box.add(Vec3<Real>(paths.to[n]) - frame, margin);
        boxes_.nodes[n] = box;
    });
    const auto hull = [&](std::initializer_list<std::uint32_t> nodes) {
        AxisBox<Real> box;
        for (const std::uint32_t n : nodes) box.add(boxes_.nodes[n]);
        return box;
    };
    for_each_index(faces, [&](std::uint32_t f) {
        const Face& face = model_->faces[f];
        boxes_.faces[f] = hull({face.a, face.b, face.c});
        boxes_.face_columns.set(f, boxes_.faces[f]);
    });
    for_each_index(Range{first.y, end.y - first.y}, [&](std::uint32_t e) {
        boxes_.edges[e] = hull({parts.edges[e].a, parts.edges[e].b});
        boxes_.edge_columns.set(e, boxes_.edges[e]);
    });
    const std::uint32_t root = model_->face_trees.roots[object];
    update_tree_boxes<Real>(model_->face_trees, root, boxes_.faces, boxes_.trees);
    bounding_boxes_[object] = swept(boxes_.trees[root], frame);
    if (has_changed_[object] == 0) return;
    for_each_index(faces, [&](std::uint32_t f) {
        boxes_.changed_faces[f] = is_changed_face_[f] != 0 ? boxes_.faces[f] : AxisBox<Real>();
    });
    update_tree_boxes<Real>(model_->face_trees, root, boxes_.changed_faces, boxes_.changed);
}

template <class Real>
bool FindPairs<Real>::has_changed_node(const Face& face) const {
    return is_changed_[face.a] != 0 || is_changed_[face.b] != 0 || is_changed_[face.c] != 0;
}

// Whether a node of an object's tree has a face that has.
template <class Real>
bool FindPairs<Real>::has_changed(std::uint32_t object, std::uint32_t node) const {
    return has_changed_[object] != 0 && boxes_.changed[node].min.x <= boxes_.changed[node].max.x;
}

template <class Real>
bool FindPairs<Real>::has_changed_node(const ContactPair& pair) const {
    return std::any_of(pair.nodes.begin(), pair.nodes.end(),
                       [&](std::uint32_t n) { return is_changed_[n] != 0; });
}

template <class Real>
void FindPairs<Real>::add_lost(std::uint32_t object, std::span<const LostTets> lost) {
    Own& own = owns_[object];
    for (const LostTets& tets : lost) {
        own.lost.push_back(tets);
        const AxisBox<Real> box = kept_.box_of(object, tets);
        own.boxes.add(box);
        own.all.add(box);
    }
}

template <class Real>
void FindPairs<Real>::find_own(const Paths<Real>& paths) {
    for (std::uint32_t o = 0; o < model_->body_count(); ++o) {
        owns_[o] = {};
        if (!kept_.is_convex(o) || is_still_[o] != 0) continue;
        add_lost(o, kept_.find_lost_tets(o, static_cast<Real>(tuning::kNearly), paths.from, paths.to));
        owns_[o].listed = owns_[o].boxes.size();
    }
}

template <class Real>
bool FindPairs<Real>::find_lost(std::span<const Vec4<Real>> ends) {
    bool any = false;
    for (std::uint32_t o = 0; finds_own_ && o < model_->body_count(); ++o) {
        if (!kept_.is_convex(o) || is_still_[o] != 0) continue;
        add_lost(o, kept_.find_more_lost(o, static_cast<Real>(tuning::kNearly), owns_[o].lost, ends));
        any = any || owns_[o].boxes.size() > owns_[o].listed;
    }
    return any;
}

template <class Real>
bool FindPairs<Real>::may_meet(std::uint32_t object, std::uint32_t other) const {
    if (other != object)
        return (model_->is_body(object) || model_->is_body(other)) && !are_joined(joined_, object, other);
    return finds_own_ && model_->is_body(object) && !model_->objects[object].is_rigid &&
           (!kept_.is_convex(object) || owns_[object].boxes.size() > 0);
}

template <class Real>
void FindPairs<Real>::begin(const Paths<Real>& paths, bool own, std::span<const std::uint8_t> asleep) {
    finds_own_ = own_ && own;
    for_each_index(0, model_->objects.size(), 1, [&](std::size_t o) {
        if (model_->objects[o].faces.count == 0) return;
        const Range& nodes = model_->objects[o].nodes;
        const bool is_still = (o < asleep.size() ? asleep[o] != 0 : !model_->is_body(o)) &&
                              std::equal(paths.to.begin() + nodes.first, paths.to.begin() + nodes.end(),
                                         paths.from.begin() + nodes.first);
        if (std::exchange(is_still_[o], is_still ? 1 : 0) != 0 && is_still) return;  // its boxes are there
        glm::dvec3 sum(0.0);
        for (std::uint32_t n = nodes.first; n < nodes.end(); ++n)
            sum += glm::dvec3(paths.to[n]) - glm::dvec3(paths.from[n]);
        motions_[o] = Vec3<Real>(sum / static_cast<double>(nodes.count));
        update_boxes(o, paths);
        if (finds_own_)
            near_at_rest_.begin(static_cast<std::uint32_t>(o), paths.from, paths.to,
                                (paths.nearness + paths.slack) * static_cast<Real>(surface_->reach(o, o)));
    });
    object_tree_.update(bounding_boxes_);
}

template <class Real>
Real FindPairs<Real>::fastest_approach(const Paths<Real>& paths) const {
    Real fastest = 0;
    for (std::uint32_t o = 0; o < model_->body_count(); ++o) {
        object_tree_.for_objects_near(bounding_boxes_[o], [&](std::uint32_t other) {
            if (other != o && may_meet(o, other))
                fastest = std::max(fastest, glm::length(motions_[other] - motions_[o]) /
                                                static_cast<Real>(surface_->reach(o, other)));
        });
        if (!finds_own_ || model_->objects[o].is_rigid) continue;
        const Range& nodes = model_->objects[o].nodes;
        Real farthest = 0;
        for (std::uint32_t n = nodes.first; n < nodes.end(); ++n)
            farthest = std::max(
                farthest, glm::length(Vec3<Real>(paths.to[n]) - Vec3<Real>(paths.from[n]) - motions_[o]));
        fastest = std::max(fastest, farthest / static_cast<Real>(surface_->reach(o, o)));
    }
    return fastest;
}

template <class Real>
void FindPairs<Real>::run(const Paths<Real>& paths) {
    if (finds_own_) find_own(paths);
    pairs_.clear();
    search_all(paths, false);
}

template <class Real>
std::size_t FindPairs<Real>::update(const Paths<Real>& paths, std::span<const std::uint32_t> nodes) {
    for (const std::uint32_t n : nodes) is_changed_[n] = has_changed_[model_->node_objects[n]] = 1;
    for_each_index(0, has_changed_.size(), 1, [&](std::size_t o) {
        if (has_changed_[o] == 0) return;
        for (std::uint32_t f = model_->objects[o].faces.first; f < model_->objects[o].faces.end(); ++f)
            is_changed_face_[f] = has_changed_node(model_->faces[f]);
        update_boxes(o, paths);
    });
    object_tree_.update(bounding_boxes_);
    std::erase_if(pairs_, [&](const NearPair<Real>& near) { return has_changed_node(near.pair); });
    const std::size_t others = pairs_.size();
    search_all(paths, true);
    for (const std::uint32_t n : nodes) is_changed_[n] = has_changed_[model_->node_objects[n]] = 0;
    for (Own& own : owns_) own.listed = own.boxes.size();
    return others;
}

// @param changed whether pairs of nodes that have changed are wanted alone
template <class Real>
void FindPairs<Real>::search_all(const Paths<Real>& paths, bool changed) {
    tbb::parallel_for(std::size_t(0), found_.size(), [&](std::size_t s) {
        found_[s].of_nodes.clear();
        found_[s].of_edges.clear();
        search(subtrees_[s], paths, changed, found_[s]);
    });
    for (const Found& found : found_)
        pairs_.insert(pairs_.end(), found.of_nodes.begin(), found.of_nodes.end());
    for (const Found& found : found_)
        pairs_.insert(pairs_.end(), found.of_edges.begin(), found.of_edges.end());
}

// use(node) for what an object has near a subtree: leaves, and nodes that are no larger than it; of a body
// itself, where the lines between them meet lost tets.
// @param starts nodes below which to look @param changed whether only what has changed is wanted
template <class Real>
template <class Use>
void FindPairs<Real>::walk(const Subtree& from, std::uint32_t object, std::span<const Range> starts,
                           bool changed, const Use& use) const {
    const std::vector<TreeNode>& nodes = model_->face_trees.nodes;
    const AxisBox<Real> box = swept(boxes_.trees[from.root], motions_[from.object] - motions_[object]);
    const Own& own = owns_[object];
    const bool is_convex = object == from.object && kept_.is_convex(object),
               has_new = object == from.object && own.boxes.size() > own.listed;
    const std::vector<AxisBox<Real>>& boxes = changed && !has_new ? boxes_.changed : boxes_.trees;
    const std::uint32_t size = nodes[from.root].skip - from.root;
    for (const Range& start : starts) {
        for (std::uint32_t n = start.first; n < start.end();) {
            const bool is_near =
                meet(box, boxes[n]) && !(is_convex && is_kept(own, own.boxes.size(), from.root, n));
            const bool is_small = nodes[n].item_count > 0 || nodes[n].skip - n <= size;
            if (is_near && is_small) use(n);
            n = is_near && !is_small ? n + 1 : nodes[n].skip;
        }
    }
}

// Edges of two leaves meet in one of both searches.
template <class Real>
void FindPairs<Real>::add_leaf(const Subtree& from, std::uint32_t object, std::uint32_t leaf,
                               Found& found) const {
    const std::vector<glm::uvec2>& starts = model_->surface_parts.face_starts;
    const TreeNode& node = model_->face_trees.nodes[leaf];
    const Own& own = owns_[object];
    const bool is_own = object == from.object;
    const bool is_new = is_own && own.boxes.size() > own.listed && is_kept(own, own.listed, from.root, leaf);
    const std::uint32_t first = node.first_item, last = first + node.item_count;
    const auto add = [](std::vector<Range>& ranges, std::uint32_t begin, std::uint32_t end) {
        if (ranges.empty() || ranges.back().end() != begin) ranges.push_back({begin, 0});
        ranges.back().count += end - begin;
    };
    add(found.faces[is_new ? 1 : 0], first, last);
    if (is_own ? leaf >= from.root : object > from.object)
        add(found.edges[is_new ? 1 : 0], starts[first].y, starts[last].y);
}

// Whether the lines between what two nodes of a tree have meet none of the first `count` boxes round lost
// tets at the start.
template <class Real>
bool FindPairs<Real>::is_kept(const Own& own, std::uint32_t count, std::uint32_t node,
                              std::uint32_t other) const {
    AxisBox<Real> lines = rest_boxes_[node];
    lines.add(rest_boxes_[other]);
    return !meet(own.all, lines) || !any_meets(lines, own.boxes, count);
}

// use(number of the leaf's box, number of a column, whether it is new) for all that meet.
template <class Real>
template <class Use>
void FindPairs<Real>::for_meeting(const BoxColumns<Real>& columns,
                                  const std::array<std::vector<Range>, 2>& ranges, const Use& use,
                                  Found& found) const {
    for (const bool is_new : {false, true}) {
        found.meeting.clear();
        find_meeting(found.boxes, columns, ranges[is_new ? 1 : 0], found.meeting);
        for (const BoxPair& meeting : found.meeting) use(meeting.first, meeting.second, is_new);
    }
}

template <class Real>
void FindPairs<Real>::search(const Subtree& subtree, const Paths<Real>& paths, bool changed,
                             Found& found) const {
    const std::vector<TreeNode>& nodes = model_->face_trees.nodes;
    const std::uint32_t object = subtree.object, root = subtree.root;
    const auto has_new = [&](std::uint32_t other) {
        return has_changed_[other] != 0 ||
               (other == object && owns_[object].boxes.size() > owns_[object].listed);
    };
    // Where nothing of a node has changed, only what has is of interest.
    const auto others_alone = [&](std::uint32_t node) { return changed && !has_changed(object, node); };
    found.objects.clear();
    object_tree_.for_objects_near(swept(boxes_.trees[root], motions_[object]), [&](std::uint32_t other) {
        if ((others_alone(root) && !has_new(other)) || (is_still_[object] != 0 && is_still_[other] != 0))
            return;
        if (may_meet(object, other)) found.objects.push_back(other);
    });
    std::sort(found.objects.begin(), found.objects.end());
    found.starts.clear();
    found.start_counts.clear();
    for (const std::uint32_t other : found.objects) {
        const std::uint32_t first = model_->face_trees.roots[other];
        const std::size_t before = found.starts.size();
        if (other == object && !changed && near_at_rest_.is_enough(object)) {
            found.starts.push_back({first, 0});  // leaves know
            found.start_counts.push_back(1);
            continue;
        }
        walk(subtree, other, std::array{Range{first, nodes[first].skip - first}}, others_alone(root),
             [&](std::uint32_t n) {
                 found.starts.push_back({n, nodes[n].skip - n});
             });
        found.start_counts.push_back(static_cast<std::uint32_t>(found.starts.size() - before));
    }
    if (found.starts.empty()) return;
    found.maybe_nodes.clear();
    found.maybe_edges.clear();
    for (std::uint32_t leaf = root; leaf < nodes[root].skip; ++leaf) {
        if (nodes[leaf].item_count == 0) continue;
        std::span<const Range> starts = found.starts;
        for (std::size_t k = 0; k < found.objects.size(); ++k) {
            const std::span<const Range> of_object = starts.first(found.start_counts[k]);
            starts = starts.subspan(of_object.size());
            if (!of_object.empty() && !(others_alone(leaf) && !has_new(found.objects[k])))
                search({object, leaf}, found.objects[k], of_object, changed, found);
        }
    }
    keep_near(paths, found.maybe_nodes, found.of_nodes);
    keep_near(paths, found.maybe_edges, found.of_edges);
}

template <class Real>
void FindPairs<Real>::search(const Subtree& leaf, std::uint32_t other, std::span<const Range> starts,
                             bool changed, Found& found) const {
    const SurfaceParts& parts = model_->surface_parts;
    const TreeNode& faces = model_->face_trees.nodes[leaf.root];
    const glm::uvec2 first = parts.face_starts[faces.first_item],
                     end = parts.face_starts[faces.first_item + faces.item_count];
    if (first == end) return;
    const std::uint32_t object = leaf.object;
    const Vec3<Real> motion = motions_[object] - motions_[other];  // beside the other
    for (std::vector<Range>& ranges : found.faces) ranges.clear();
    for (std::vector<Range>& ranges : found.edges) ranges.clear();
    if (other == object && !changed && near_at_rest_.is_enough(object)) {
        near_at_rest_.find(object, leaf.root, found.leaves);
        for (const std::uint32_t n : found.leaves) add_leaf(leaf, other, n, found);
    } else {
        walk(leaf, other, starts, changed && !has_changed(object, leaf.root),
             [&](std::uint32_t n) { add_leaf(leaf, other, n, found); });
    }
    const auto reach = static_cast<float>(surface_->reach(object, other));
    const auto add = [&](const ContactPair& pair, bool is_new) {
        if (!changed || is_new || has_changed_node(pair))
            (pair.is_edges() ? found.maybe_edges : found.maybe_nodes).push_back(pair);
    };
    found.boxes.clear();
    for (std::uint32_t place = first.x; place < end.x; ++place)
        found.boxes.push_back(swept(boxes_.nodes[parts.nodes[place]], motion));
    for_meeting(
        boxes_.face_columns, found.faces,
        [&](std::uint32_t k, std::uint32_t f, bool is_new) {
            const std::uint32_t n = parts.nodes[first.x + k];
            const Face& face = model_->faces[f];
            if (!has_corner(face, n))
                add({{n, face.a, face.b, face.c}, n, f, object, other, 1, reach}, is_new);
        },
        found);
    if (other < object) return;
    found.boxes.clear();
    for (std::uint32_t e = first.y; e < end.y; ++e) found.boxes.push_back(swept(boxes_.edges[e], motion));
    for_meeting(
        boxes_.edge_columns, found.edges,
        [&](std::uint32_t k, std::uint32_t to, bool is_new) {
            const std::uint32_t e = first.y + k;
            const FaceEdge &edge = parts.edges[e], &near = parts.edges[to];
            // Of a body itself, only later ones.
            if (other != object || (to > e && !share_end(edge, near)))
                add({{edge.a, edge.b, near.a, near.b}, e, to, object, other, 2, reach}, is_new);
        },
        found);
}

// Where a direction separates the two sides at both ends, it does so all the way, as nodes go straight. Here
// with room for both slacks and what is near.
template <class Real>
void FindPairs<Real>::keep_near(const Paths<Real>& paths, std::span<const ContactPair> candidates,
                                std::vector<NearPair<Real>>& kept) const {
    for_measured<Real>(
        candidates, paths.from, [&](std::size_t p, const MeasuredPairs<Real>& measured, std::size_t c) {
            const ContactPair& pair = candidates[p];
            const auto reach = static_cast<Real>(pair.reach);
            const Real wanted =
                std::max(paths.nearness * reach, Real(2) * measured.rounding[c]) + paths.slack * reach;
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
            // Not between bodies: what these exert on each other along another line would have a moment.
            const bool is_collider = !model_->is_body(pair.object) || !model_->is_body(pair.other);
            if (is_collider && !paths.velocities.empty()) look_beside_way(paths, kept.back());
        });
}

template class FindPairs<float>;
template class FindPairs<double>;

}  // namespace gelatin::cpu
