#include "cpu/contact/near_objects.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/disjoint_sets.h"
#include "cpu/contact/island_motions.h"
#include "cpu/contact/planes.h"
#include "cpu/contact/swept_box.h"

namespace gelatin::cpu {
namespace {

// Of the distance between islands: how far an island may go.
constexpr double kShifted = 0.2;

}  // namespace

template <class Real>
NearObjects<Real>::NearObjects(std::shared_ptr<const Model> model, const ContactSurface& surface,
                               const Collision<Real>& collision)
    : model_(std::move(model)),
      collision_(collision),
      listed_(most_listed(surface)),
      margin_(BoxMargin<Real>::for_distance(listed_)),
      listed_thicknesses_(surface.thicknesses),
      boxes_(model_->objects.size()),
      drifts_(model_->objects.size()),
      object_tree_(static_cast<std::uint32_t>(model_->objects.size())),
      near_(model_->objects.size()),
      meeting_(model_->objects.size()),
      by_distance_(model_->objects.size()) {
    double thinnest = std::numeric_limits<double>::infinity();
    for (std::size_t o = 0; o < model_->body_count(); ++o)
        thinnest = std::min(thinnest, surface.thicknesses[o]);
    for (std::size_t c = 0; c < model_->surfaces.size(); ++c)
        if (model_->surfaces[c].moves) listed_thicknesses_[model_->body_count() + c] = thinnest;
}

template <class Real>
double NearObjects<Real>::most_listed(const ContactSurface& surface) {
    return kListedReach * 2.0 * *std::max_element(surface.thicknesses.begin(), surface.thicknesses.end());
}

// With rooms of 0.45 (1/4 + 1/4) of the distance between islands, ways of twice the longest motion on each
// side, and shifts of 1/5, nodes of two islands do not meet.
template <class Real>
void NearObjects<Real>::run(std::span<const Vec4<Real>> positions, const Expected<Real>& expected,
                            ContactList<Real>& list) {
    island_distance_ = 4.0 * (listed_ + 3.0 * expected.longest);
    list.most_shift = static_cast<Real>(kShifted * island_distance_);
    positions_ = positions;
    boxes_ = boxes_at(positions);
    find_near_objects();
    find_islands(list);
    find_drifts(expected, list);
}

template <class Real>
std::vector<AxisBox<Real>> NearObjects<Real>::boxes_at(std::span<const Vec4<Real>> positions) const {
    std::vector<AxisBox<Real>> boxes(model_->objects.size());
    tbb::parallel_for(std::size_t(0), boxes.size(), [&](std::size_t o) {
        const Range& nodes = model_->objects[o].nodes;
        for (std::uint32_t n = nodes.first; n < nodes.end(); ++n)
            boxes[o].add(Vec3<Real>(positions[n]), margin_);
    });
    return boxes;
}

template <class Real>
std::vector<std::uint8_t> NearObjects<Real>::find_meeting(std::span<const Vec4<Real>> positions,
                                                          std::span<const Vec3<Real>> motions) const {
    const std::vector<AxisBox<Real>> boxes = boxes_at(positions);
    std::vector<std::uint8_t> meeting(model_->body_count());
    tbb::parallel_for(std::size_t(0), meeting.size(), [&](std::size_t o) {
        meeting[o] = std::any_of(near_[o].begin(), near_[o].end(), [&](std::uint32_t other) {
            return !model_->is_body(other) ||
                   meet(swept(boxes[o], motions[o] - motions[other]), boxes[other]);
        });
    });
    return meeting;
}

template <class Real>
void NearObjects<Real>::find_near_objects() {
    const auto count = static_cast<std::uint32_t>(model_->objects.size());
    const auto bodies = static_cast<std::uint32_t>(model_->body_count());
    const auto apart = static_cast<Real>(island_distance_);
    object_tree_.update(boxes_);
    tbb::parallel_for(std::uint32_t(0), bodies, [&](std::uint32_t o) {
        AxisBox<Real> around = boxes_[o];
        around.min -= apart;
        around.max += apart;
        near_[o].clear();
        object_tree_.for_objects_near(around, [&](std::uint32_t other) {
            if (other != o && (other < bodies || reaches(other, boxes_[o], apart))) near_[o].push_back(other);
        });
    });
    for (std::uint32_t c = bodies; c < count; ++c) near_[c].clear();
    for (std::uint32_t o = 0; o < bodies; ++o) {
        for (const std::uint32_t other : near_[o])
            if (other >= bodies) near_[other].push_back(o);
    }
}

// Bodies can be far from all faces of a large collider, and within its box.
// @param most distance beyond what is listed [m]
template <class Real>
bool NearObjects<Real>::reaches(std::uint32_t collider, const AxisBox<Real>& box, Real most) const {
    if (model_->surfaces[collider - model_->body_count()].moves) return true;
    const BoxTree& trees = model_->face_trees;
    const std::uint32_t end = trees.nodes[trees.roots[collider]].skip;
    for (std::uint32_t n = trees.roots[collider]; n < end;) {
        const bool is_near = squared_distance(box, collision_.tree_boxes()[n]) <= most * most;
        if (is_near && trees.nodes[n].item_count > 0 && squared_gap(box, Vec3<Real>(0), n) <= most * most)
            return true;
        n = is_near ? n + 1 : trees.nodes[n].skip;
    }
    return false;
}

template <class Real>
Real NearObjects<Real>::squared_gap(const AxisBox<Real>& box, const Vec3<Real>& drift,
                                    std::uint32_t leaf) const {
    const TreeNode& faces = model_->face_trees.nodes[leaf];
    const Vec3<Real> center = Real(0.5) * (box.min + box.max), half = Real(0.5) * (box.max - box.min);
    const AxisBox<Real> passed = swept(box, drift);
    Real least = std::numeric_limits<Real>::infinity();
    for (std::uint32_t f = faces.first_item; f < faces.first_item + faces.item_count; ++f) {
        Real squared = squared_distance(passed, collision_.face_boxes()[f]);
        const Face& face = model_->faces[f];
        if (model_->surfaces[face.object - model_->body_count()].moves) {
            least = std::min(least, squared);
            continue;
        }
        const Vec3<Real> a(positions_[face.a]);
        const Vec3<Real> across =
            glm::cross(Vec3<Real>(positions_[face.b]) - a, Vec3<Real>(positions_[face.c]) - a);
        const Real length = glm::length(across);
        if (length > Real(0)) {
            // From the box, which has the margin, to the plane of the face, less the margin of the face.
            const Vec3<Real> normal = across / length, margin = margin_.at(glm::abs(a) + glm::abs(center));
            const Real start = glm::dot(normal, center - a), end = start + glm::dot(normal, drift);
            const Real height = start > Real(0) ? std::min(start, end) : -std::max(start, end);
            const Real gap = height - glm::dot(glm::abs(normal), half + margin);
            if (gap > Real(0)) squared = std::max(squared, gap * gap);
        }
        least = std::min(least, squared);
    }
    return least;
}

template <class Real>
void NearObjects<Real>::sort(Real most) {
    const std::vector<AxisBox<Real>>& boxes = collision_.bounding_boxes();
    tbb::parallel_for(std::size_t(0), near_.size(), [&](std::size_t index) {
        const auto o = static_cast<std::uint32_t>(index);
        meeting_[o].clear();
        by_distance_[o].clear();
        for (const std::uint32_t other : near_[o]) {
            NearObject<Real> near{Real(0), other, spare_margin(o, other), drift_towards(o, other)};
            near.squared = squared_distance(trimmed(swept(boxes[o], near.drift), near.spare), boxes[other]);
            if (!(near.squared > Real(0))) meeting_[o].push_back(near);
            if (near.squared < most * most) by_distance_[o].push_back(near);
        }
        std::sort(meeting_[o].begin(), meeting_[o].end(),
                  [](const auto& a, const auto& b) { return a.object < b.object; });
        std::sort(by_distance_[o].begin(), by_distance_[o].end(), [](const auto& a, const auto& b) {
            return a.squared < b.squared || (a.squared == b.squared && a.object < b.object);
        });
    });
}

// By union of bodies that are near each other; islands are numbered in the order of their first objects.
template <class Real>
void NearObjects<Real>::find_islands(ContactList<Real>& list) {
    const auto count = static_cast<std::uint32_t>(model_->objects.size());
    DisjointSets islands(count);
    for (std::uint32_t o = 0; o < model_->body_count(); ++o)
        for (const std::uint32_t other : near_[o])
            if (model_->is_body(other)) islands.unite(o, other);
    list.islands.resize(count);
    list.is_alone.clear();
    list.is_fixed.clear();
    for (std::uint32_t o = 0; o < count; ++o) {
        const std::uint32_t first = islands.least(o);
        list.islands[o] = first == o ? static_cast<std::uint32_t>(list.is_alone.size()) : list.islands[first];
        if (first == o) {
            list.is_alone.push_back(1);
            list.is_fixed.push_back(0);
        } else {
            list.is_alone[list.islands[o]] = 0;
        }
        const bool is_near_collider = std::any_of(
            near_[o].begin(), near_[o].end(), [&](std::uint32_t other) { return !model_->is_body(other); });
        if (is_near_collider) list.is_alone[list.islands[o]] = 0;
        if (is_near_collider || !model_->is_body(o)) list.is_fixed[list.islands[o]] = 1;
    }
    list.shifts.assign(list.is_alone.size(), Vec3<Real>(0));
}

// Islands near colliders have what they do as their course.
template <class Real>
void NearObjects<Real>::find_drifts(const Expected<Real>& expected, ContactList<Real>& list) {
    const std::size_t islands = list.is_alone.size();
    list.drifts.assign(islands, Vec3<Real>(0));
    list.drifted.assign(islands, Real(0));
    std::vector<Vec3<Real>> means = island_motions<Real>(*model_, list, expected.motions, expected.stays);
    keep_outside_planes(*model_, list, positions_, means);
    for (std::size_t i = 0; i < islands; ++i)
        if (list.is_fixed[i] != 0) list.drifts[i] = means[i];
    for (std::size_t o = 0; o < drifts_.size(); ++o) drifts_[o] = means[list.islands[o]];
}

template <class Real>
Real NearObjects<Real>::spare_margin(std::uint32_t object, std::uint32_t other) const {
    return static_cast<Real>(listed_ - listed(object, other));
}

template <class Real>
Vec3<Real> NearObjects<Real>::drift_towards(std::uint32_t object, std::uint32_t other) const {
    return model_->is_body(object) && model_->is_body(other) ? Vec3<Real>(0)
                                                             : drifts_[object] - drifts_[other];
}

template class NearObjects<float>;
template class NearObjects<double>;

}  // namespace gelatin::cpu
