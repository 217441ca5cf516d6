#include "cpu/contact/own_gaps.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <limits>
#include <numeric>
#include <utility>

#include "cpu/collision/triangle_overlap.h"
#include "cpu/contact/nearest_pairs.h"
#include "model/nearest_rotation.h"

namespace gelatin::cpu {
namespace {

constexpr std::size_t kLeavesATask = 32;
// Of a way, where it does not tell as a whole that gaps stay open.
constexpr int kParts = 4;

// What is left of a gap on the way of its nodes, along the line between the nearest points at the start.
template <class Real>
Real least_gap(const ContactPair& pair, const MeasuredPairs<Real>& measured, std::size_t column,
               std::span<const Vec3<Real>> ways) {
    const Real gap = measured.gaps[column];
    if (!(gap > Real(0))) return Real(0);
    const Vec3<Real> normal =
        Vec3<Real>(measured.apart[0][column], measured.apart[1][column], measured.apart[2][column]) / gap;
    Real top = -std::numeric_limits<Real>::infinity(), low = -top;
    for (std::size_t k = 0; k < 4; ++k) {
        const Real end = measured.heights[k][column] + glm::dot(normal, ways[pair.nodes[k]]);
        if (pair.side_of(k) == 0) {
            top = std::max(top, end);
        } else {
            low = std::min(low, end);
        }
    }
    return std::min(gap, low - top) - measured.rounding[column];
}

}  // namespace

template <class Real>
OwnGaps<Real>::OwnGaps(std::shared_ptr<const Model> model, std::shared_ptr<const ContactSurface> surface)
    : model_(std::move(model)),
      surface_(std::move(surface)),
      starts_(model_->node_count()),
      ways_(model_->node_count()),
      boxes_(model_) {}

// Where ways are long, single parts of them tell more than the whole: pairs are measured at the start of
// each.
template <class Real>
bool OwnGaps<Real>::stay_open(std::uint32_t object, std::span<const Vec4<Real>> from,
                              std::span<const Vec4<Real>> to) {
    find_ways(object, from, to);
    if (part_stays_open(object)) return true;
    const SurfaceParts& parts = model_->surface_parts;
    const Range& faces = model_->objects[object].faces;
    const std::uint32_t first = parts.face_starts[faces.first].x, end = parts.face_starts[faces.end()].x;
    for (std::uint32_t s = first; s < end; ++s) ways_[parts.nodes[s]] /= Real(kParts);
    for (int part = 0;; ++part) {
        if (!part_stays_open(object)) return false;
        if (part + 1 == kParts) return true;
        for (std::uint32_t s = first; s < end; ++s)
            starts_[parts.nodes[s]] += Vec4<Real>(ways_[parts.nodes[s]], Real(0));
    }
}

template <class Real>
bool OwnGaps<Real>::part_stays_open(std::uint32_t object) {
    const auto margin = BoxMargin<Real>::for_distance(surface_->reach(object, object));
    boxes_.update(object, [&](std::uint32_t n, AxisBox<Real>& box) {
        const Vec3<Real> start(starts_[n]);
        box.add(start, margin);
        box.add(start + ways_[n], margin);
    });
    return all_walks(object, [&](std::span<const std::uint32_t> walk, typename OwnBoxes<Real>::Near& near) {
        const auto all = [](std::uint32_t) { return true; };
        std::vector<ContactPair> waiting;
        const auto wait = [&](const ContactPair& pair) { waiting.push_back(pair); };
        for (const std::uint32_t leaf : walk) boxes_.for_node_pairs(leaf, all, near, wait);
        if (!are_open(waiting)) return false;
        for (const std::uint32_t leaf : walk) boxes_.for_edge_pairs(leaf, all, near, wait);
        return are_open(waiting);
    });
}

template <class Real>
template <class Test>
bool OwnGaps<Real>::all_walks(std::uint32_t object, const Test& test) const {
    const Range range = boxes_.leaves_of(object);
    std::vector<std::uint32_t> leaves(range.count);
    std::iota(leaves.begin(), leaves.end(), range.first);
    std::atomic<bool> all = true;
    tbb::parallel_for(std::size_t(0), (leaves.size() + kLeavesATask - 1) / kLeavesATask,
                      [&](std::size_t task) {
                          const auto not_twice = [](std::uint32_t) { return false; };
                          typename OwnBoxes<Real>::Near near;
                          const std::size_t first = task * kLeavesATask,
                                            count = std::min(kLeavesATask, leaves.size() - first);
                          for_walks(std::span<const std::uint32_t>(leaves).subspan(first, count),
                                    [&](std::span<const std::uint32_t> walk) {
                                        if (!all.load(std::memory_order_relaxed)) return;
                                        boxes_.find_near(object, walk, not_twice, near);
                                        if (!test(walk, near)) all = false;
                                    });
                      });
    return all;
}

template <class Real>
bool OwnGaps<Real>::passes_through_itself(std::uint32_t object, std::span<const Vec4<Real>> positions) {
    boxes_.update(object, [&](std::uint32_t n, AxisBox<Real>& box) { box.add(Vec3<Real>(positions[n])); });
    const auto triangle = [&](std::uint32_t f) {
        const Face& face = model_->faces[f];
        return Triangle<Real>{Vec3<Real>(positions[face.a]), Vec3<Real>(positions[face.b]),
                              Vec3<Real>(positions[face.c])};
    };
    return !all_walks(object, [&](std::span<const std::uint32_t> walk, typename OwnBoxes<Real>::Near& near) {
        bool any = false;
        for (const std::uint32_t leaf : walk)
            boxes_.for_face_pairs(leaf, near, [&](std::uint32_t f, std::uint32_t other) {
                any = any || triangles_overlap(triangle(f), triangle(other));
            });
        return !any;
    });
}

template <class Real>
void OwnGaps<Real>::find_ways(std::uint32_t object, std::span<const Vec4<Real>> from,
                              std::span<const Vec4<Real>> to) {
    const SurfaceParts& parts = model_->surface_parts;
    const Range& faces = model_->objects[object].faces;
    const std::uint32_t first = parts.face_starts[faces.first].x, end = parts.face_starts[faces.end()].x;
    const glm::dvec3 origin(from[parts.nodes[first]]), origin_after(to[parts.nodes[first]]);
    glm::dvec3 sum(0.0), sum_after(0.0);
    glm::dmat3 moment(0.0);
    for (std::uint32_t s = first; s < end; ++s) {
        const glm::dvec3 before = glm::dvec3(from[parts.nodes[s]]) - origin,
                         after = glm::dvec3(to[parts.nodes[s]]) - origin_after;
        sum += before;
        sum_after += after;
        moment += glm::outerProduct(after, before);
    }
    const auto count = static_cast<double>(end - first);
    moment -= glm::outerProduct(sum_after, sum) / count;
    const auto back = glm::mat<3, 3, Real>(glm::transpose(nearest_rotation(moment)));
    const Vec3<Real> middle(origin + sum / count), middle_after(origin_after + sum_after / count);
    for (std::uint32_t s = first; s < end; ++s) {
        const std::uint32_t n = parts.nodes[s];
        const Vec3<Real> start = Vec3<Real>(from[n]) - middle;
        starts_[n] = Vec4<Real>(start, Real(0));
        ways_[n] = back * (Vec3<Real>(to[n]) - middle_after) - start;
    }
}

// Pairs press at the reach, or at half of their gap at the start if that is less. @param pairs output: none
template <class Real>
bool OwnGaps<Real>::are_open(std::vector<ContactPair>& pairs) const {
    bool open = true;
    std::size_t near = 0;
    for_measured<Real>(pairs, starts_, [&](std::size_t p, const auto& measured, std::size_t column) {
        const ContactPair pair = pairs[p];
        const Real gap = least_gap<Real>(pair, measured, column, ways_);
        if (!(gap > Real(0))) open = false;
        if (gap > static_cast<Real>(surface_->reach(pair.object, pair.other))) return;
        pairs[near] = pair;
        pairs[near++].reach = static_cast<float>(gap);
    });
    pairs.resize(near);
    if (open)
        for_measured<float>(pairs, model_->positions,
                            [&](std::size_t p, const auto& measured, std::size_t c) {
                                if (!(pairs[p].reach > 0.5f * measured.gaps[c])) open = false;
                            });
    pairs.clear();
    return open;
}

template class OwnGaps<float>;
template class OwnGaps<double>;

}  // namespace gelatin::cpu
