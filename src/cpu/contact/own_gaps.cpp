#include "cpu/contact/own_gaps.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <glm/matrix.hpp>
#include <limits>
#include <numeric>
#include <utility>

#include "cpu/collision/triangle_overlap.h"
#include "cpu/contact/least_stretch.h"
#include "cpu/contact/lower_to.h"
#include "cpu/contact/moment_between.h"
#include "cpu/contact/nearest_pairs.h"
#include "model/collision/surface_parts.h"
#include "model/for_each_index.h"
#include "model/nearest_rotation.h"

namespace gelatin::cpu {
namespace {

// How far others are looked for, over the thickness of the surface, which is a twentieth of its median edge:
// the farther, the larger rooms are, and the longer a look takes.
constexpr double kSearchedGap = 8.0, kSearchedGapAtStart = 20.0;
// Of what an affine map leaves of a gap, over that at which it presses, what both sides may use; for rounding
// a little less than half.
constexpr double kRoom = 0.49;
// Over the reach: where gaps are less, those at the start are looked at, too.
constexpr double kNear = 2.0;
// Of the mean square of what is from the middle: flatter bodies have no rooms.
constexpr double kFlatGaps = 1e-6;
// Of a way, where it does not tell as a whole that a gap stays open.
constexpr int kParts = 16;

// What is left of a gap on the way of its nodes, along the line between the nearest points where it was
// measured. @param sign 1: the way leads on from there; -1: it has led there
template <class Real>
Real least_gap(const ContactPair& pair, const MeasuredPairs<Real>& measured, std::size_t column,
               std::span<const Vec3<Real>> ways, Real sign = Real(1)) {
    const Real gap = measured.gaps[column];
    if (!(gap > Real(0))) return Real(0);
    const Vec3<Real> normal =
        Vec3<Real>(measured.apart[0][column], measured.apart[1][column], measured.apart[2][column]) / gap;
    Real top = -std::numeric_limits<Real>::infinity(), low = -top;
    for (std::size_t k = 0; k < 4; ++k) {
        const Real other_end = measured.heights[k][column] + sign * glm::dot(normal, ways[pair.nodes[k]]);
        if (pair.side_of(k) == 0) {
            top = std::max(top, other_end);
        } else {
            low = std::min(low, other_end);
        }
    }
    return std::min(gap, low - top) - measured.rounding[column];
}

}  // namespace

template <class Real>
OwnGaps<Real>::OwnGaps(std::shared_ptr<const Model> model, std::shared_ptr<const ContactSurface> surface)
    : model_(std::move(model)),
      surface_(std::move(surface)),
      shapes_(model_->body_count()),
      starts_(model_->node_count()),
      ways_(model_->node_count()),
      apart_(model_->surface_parts.nodes.size()),
      boxes_(model_),
      leaves_at_start_(model_->face_trees.levels[0].size()) {
    for (std::uint32_t f = 0; f < model_->faces.size(); ++f)
        for (const std::uint32_t n : corners_of(model_->faces[f]))
            leaves_at_start_[boxes_.leaf_of_face(f)].add(Vec3<Real>(glm::vec3(model_->positions[n])));
    const std::vector<Vec4<Real>> at_start(model_->positions.begin(), model_->positions.end());
    for_each_index(0, shapes_.size(), 1, [&](std::size_t index) {
        const auto o = static_cast<std::uint32_t>(index);
        const Range& faces = model_->objects[o].faces;
        if (faces.count == 0) return;
        shapes_[o].places = surface_places(model_->surface_parts, faces);
        find_ways(o, at_start, at_start);
        look(o, kSearchedGapAtStart * surface_->thicknesses[o], std::nullopt);
    });
}

template <class Real>
bool OwnGaps<Real>::hold(std::uint32_t object, std::span<const Vec4<Real>> positions) const {
    const Shape& shape = shapes_[object];
    if (shape.inverse_moment == glm::dmat3(0.0)) return false;
    const std::vector<std::uint32_t>& nodes = model_->surface_parts.nodes;
    const MomentBetween between = moment_between(
        shape.places, [&](std::uint32_t s) { return Vec3<Real>(starts_[nodes[s]]); },
        [&](std::uint32_t s) { return Vec3<Real>(positions[nodes[s]]); });
    const glm::dmat3 exact = between.moment * shape.inverse_moment;
    const auto linear = glm::mat<3, 3, Real>(exact);
    const auto least = static_cast<Real>(std::min(least_stretch(exact), 1.0));
    const Vec3<Real> middle(between.middle_b);
    const Real lost = (Real(1) - least) * static_cast<Real>(reach(object));
    for (std::uint32_t s = shape.places.first; s < shape.places.end(); ++s) {
        const Vec3<Real> deviation =
            Vec3<Real>(positions[nodes[s]]) - middle - linear * Vec3<Real>(starts_[nodes[s]]);
        const Real room = static_cast<Real>(kRoom) * (least * apart_[s] - lost);
        if (!(room > Real(0)) || !(glm::dot(deviation, deviation) < room * room)) return false;
    }
    return true;
}

template <class Real>
bool OwnGaps<Real>::stay_open(std::uint32_t object, std::span<const Vec4<Real>> from,
                              std::span<const Vec4<Real>> to, Between between) {
    find_ways(object, from, to);
    return look(object, kSearchedGap * surface_->thicknesses[object], between);
}

// Where starts and ways are. @param searched how far others are looked for [m]
template <class Real>
bool OwnGaps<Real>::look(std::uint32_t object, double searched, const Between& between) {
    const Range& places = shapes_[object].places;
    std::fill_n(apart_.begin() + places.first, places.count, static_cast<Real>(searched - reach(object)));
    const auto margin = BoxMargin<Real>::for_distance(searched);
    boxes_.update(object, [&](std::uint32_t n, AxisBox<Real>& box) {
        const Vec3<Real> start(starts_[n]);
        box.add(start, margin);
        box.add(start + ways_[n], margin);
    });
    const auto test = [&](std::span<const std::uint32_t> walk, typename OwnBoxes<Real>::Near& near) {
        const auto all = [](std::uint32_t) { return true; };
        std::vector<ContactPair> waiting;
        const auto wait = [&](const ContactPair& pair) { waiting.push_back(pair); };
        for (const std::uint32_t leaf : walk) boxes_.for_node_pairs(leaf, all, near, wait);
        if (!are_open(waiting)) return false;
        for (const std::uint32_t leaf : walk) boxes_.for_edge_pairs(leaf, all, near, wait);
        return are_open(waiting);
    };
    const bool open = all_walks(object, between, test);
    // Rooms are of all pairs: this look ended before it was at them, or left some out.
    if (!open || between) shapes_[object].inverse_moment = glm::dmat3(0.0);
    return open;
}

template <class Real>
template <class Test>
bool OwnGaps<Real>::all_walks(std::uint32_t object, const Between& between, const Test& test) const {
    const Range range = boxes_.leaves_of(object);
    std::vector<std::uint32_t> leaves(range.count);
    std::iota(leaves.begin(), leaves.end(), range.first);
    const auto not_twice = [](std::uint32_t) { return false; };
    std::atomic<bool> all = true;
    using Near = typename OwnBoxes<Real>::Near;
    for_walks<Near>(leaves, [&](std::span<const std::uint32_t> walk, Near& near) {
        if (!all.load(std::memory_order_relaxed)) return;
        AxisBox<Real> at_start;
        for (const std::uint32_t leaf : walk) at_start.add(leaves_at_start_[leaf]);
        const auto counts = [&](std::uint32_t leaf) {
            if (!between) return true;
            AxisBox<Real> both = at_start;
            both.add(leaves_at_start_[leaf]);
            return std::any_of(between->begin(), between->end(),
                               [&](const AxisBox<Real>& box) { return meet(both, box); });
        };
        boxes_.find_near(object, walk, not_twice, counts, near);
        if (!test(walk, near)) all = false;
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
    const auto test = [&](std::span<const std::uint32_t> walk, typename OwnBoxes<Real>::Near& near) {
        bool any = false;
        for (const std::uint32_t leaf : walk)
            boxes_.for_face_pairs(leaf, near, [&](std::uint32_t f, std::uint32_t other) {
                any = any || triangles_overlap(triangle(f), triangle(other));
            });
        return !any;
    };
    return !all_walks(object, std::nullopt, test);
}

template <class Real>
void OwnGaps<Real>::find_ways(std::uint32_t object, std::span<const Vec4<Real>> from,
                              std::span<const Vec4<Real>> to) {
    const std::vector<std::uint32_t>& nodes = model_->surface_parts.nodes;
    Shape& shape = shapes_[object];
    const auto before = [&](std::uint32_t s) { return Vec3<Real>(from[nodes[s]]); };
    const glm::dmat3 square = moment_between(shape.places, before, before).moment;
    const MomentBetween between =
        moment_between(shape.places, before, [&](std::uint32_t s) { return Vec3<Real>(to[nodes[s]]); });
    const double mean = (square[0][0] + square[1][1] + square[2][2]) / 3.0;
    const bool is_flat = !(glm::determinant(square) > kFlatGaps * mean * mean * mean);
    shape.inverse_moment = is_flat ? glm::dmat3(0.0) : glm::inverse(square);
    const auto back = glm::mat<3, 3, Real>(glm::transpose(nearest_rotation(between.moment)));
    const Vec3<Real> middle(between.middle_a), middle_after(between.middle_b);
    for (std::uint32_t s = shape.places.first; s < shape.places.end(); ++s) {
        const std::uint32_t n = nodes[s];
        const Vec3<Real> start = Vec3<Real>(from[n]) - middle;
        starts_[n] = Vec4<Real>(start, Real(0));
        ways_[n] = back * (Vec3<Real>(to[n]) - middle_after) - start;
    }
}

// Pairs press at the reach, or at half of their gap at the start if that is less. @param pairs output: none
template <class Real>
bool OwnGaps<Real>::are_open(std::vector<ContactPair>& pairs) {
    const auto tell_apart = [&](const ContactPair& pair, Real apart) {
        for (const std::uint32_t n : pair.nodes)
            lower_to(apart_[surface_->places[n]], std::max(apart, Real(0)));
    };
    struct Gap {
        Real now, least;
    };
    std::vector<Gap> gaps;  // of those that are near
    for_measured<Real>(pairs, starts_, [&](std::size_t p, const auto& measured, std::size_t column) {
        const Real gap = measured.gaps[column], least = least_gap<Real>(pairs[p], measured, column, ways_);
        const auto most = static_cast<Real>(reach(pairs[p].object));
        if (least > most && gap > Real(kNear) * most) {
            tell_apart(pairs[p], gap - most);
            return;
        }
        pairs[gaps.size()] = pairs[p];
        gaps.push_back({gap, least});
    });
    pairs.resize(gaps.size());
    std::size_t near = 0;
    for_measured<float>(
        pairs, model_->positions, [&](std::size_t p, const auto& measured, std::size_t column) {
            const float press =
                std::min(static_cast<float>(reach(pairs[p].object)), 0.5f * measured.gaps[column]);
            tell_apart(pairs[p], gaps[p].now - static_cast<Real>(press));
            if (gaps[p].least > static_cast<Real>(press)) return;
            pairs[near] = pairs[p];
            pairs[near++].reach = press;
        });
    pairs.resize(near);
    const bool open = are_open_by_parts(pairs);
    pairs.clear();
    return open;
}

// Where ways are long, single parts of them tell more than the whole: pairs are measured at the start of
// each.
template <class Real>
bool OwnGaps<Real>::are_open_by_parts(std::span<const ContactPair> pairs) const {
    std::vector<ContactPair> own(pairs.begin(), pairs.end());
    std::vector<Vec4<Real>> positions;  // of the nodes of one pair after the other
    std::vector<Vec3<Real>> ways;
    for (ContactPair& pair : own) {
        for (std::uint32_t& n : pair.nodes) {
            positions.push_back(starts_[n]);
            ways.push_back(ways_[n] / Real(kParts));
            n = static_cast<std::uint32_t>(ways.size() - 1);
        }
    }
    bool open = true;
    std::vector<std::uint8_t> is_told(own.size(), std::uint8_t(1));  // of the part before
    for (int part = 0; part <= kParts && open; ++part) {
        for_measured<Real>(own, positions, [&](std::size_t p, const auto& measured, std::size_t column) {
            const auto reach = static_cast<Real>(own[p].reach);
            if (is_told[p] == 0 && !(least_gap<Real>(own[p], measured, column, ways, Real(-1)) > reach))
                open = false;
            is_told[p] = part == kParts || least_gap<Real>(own[p], measured, column, ways) > reach ? 1 : 0;
        });
        for (std::size_t k = 0; k < ways.size(); ++k) positions[k] += Vec4<Real>(ways[k], Real(0));
    }
    return open;
}

template class OwnGaps<float>;
template class OwnGaps<double>;

}  // namespace gelatin::cpu
