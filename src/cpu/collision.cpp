#include "cpu/collision.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <numeric>
#include <utility>

#include "cpu/triangle_overlap.h"

namespace gelatin::cpu {
namespace {

constexpr std::uint32_t kFacesATask = 2048;
constexpr std::uint32_t kTestsATask = 65536;

std::uint32_t word_count(const ModelObject& object) {
    return (object.faces.count + 31) / 32;
}

template <class Real>
Triangle<Real> triangle(std::span<const Vec4<Real>> positions, const Face& face) {
    return {Vec3<Real>(positions[face.a]), Vec3<Real>(positions[face.b]), Vec3<Real>(positions[face.c])};
}

}  // namespace

template <class Real>
Collision<Real>::Collision(std::shared_ptr<const Model> model, BroadPhase broad_phase)
    : model_(std::move(model)),
      broad_phase_(broad_phase),
      face_boxes_(model_->faces.size()),
      bounding_boxes_(model_->objects.size()),
      row_starts_(model_->objects.size() + 1) {}

template <class Real>
void Collision<Real>::update_boxes(std::span<const Vec4<Real>> positions) {
    const auto faces = static_cast<std::uint32_t>(model_->faces.size());
    tbb::parallel_for(tbb::blocked_range<std::uint32_t>(0, faces, kFacesATask), [&](const auto& range) {
        for (std::uint32_t f = range.begin(); f < range.end(); ++f) {
            const Face& face = model_->faces[f];
            AxisBox<Real> box;
            for (const std::uint32_t n : {face.a, face.b, face.c}) box.add(Vec3<Real>(positions[n]));
            face_boxes_[f] = box;
        }
    });
    tbb::parallel_for(std::size_t(0), model_->objects.size(), [&](std::size_t o) {
        const Range& range = model_->objects[o].faces;
        AxisBox<Real> box;
        for (std::uint32_t f = range.first; f < range.end(); ++f) box.add(face_boxes_[f]);
        bounding_boxes_[o] = box;
    });
}

template <class Real>
void Collision<Real>::find_object_pairs() {
    const auto count = static_cast<std::uint32_t>(model_->objects.size());
    pairs_.clear();
    std::uint32_t words = 0;
    for (std::uint32_t a = 0; a < count; ++a) {
        row_starts_[a] = static_cast<std::uint32_t>(pairs_.size());
        for (std::uint32_t b = 0; b < count; ++b) {
            if (a == b) continue;
            if (broad_phase_ != BroadPhase::none && !meet(bounding_boxes_[a], bounding_boxes_[b])) continue;
            pairs_.push_back({a, b, 0, words});
            words += word_count(model_->objects[a]);
        }
    }
    row_starts_[count] = static_cast<std::uint32_t>(pairs_.size());

    // Pairs come in the order of (object, other), so those that name an object as the other one come in the
    // order of its own row.
    std::vector<std::uint32_t> next(row_starts_.begin(), row_starts_.end() - 1);
    for (ObjectPair& pair : pairs_) pair.mirror = next[pair.other]++;
    face_collisions_.assign(words, 0);
}

template <class Real>
void Collision<Real>::find_face_collisions(std::span<const Vec4<Real>> positions) {
    candidates_.resize(pairs_.size());
    tbb::parallel_for(std::size_t(0), pairs_.size(),
                      [&](std::size_t p) { candidates_[p] = find_candidates(pairs_[p]); });
    tbb::parallel_for(std::size_t(0), pairs_.size(), [&](std::size_t p) {
        if (pairs_[p].object < pairs_[p].other) test_candidates(positions, p);
    });
}

template <class Real>
std::vector<std::uint32_t> Collision<Real>::find_candidates(const ObjectPair& pair) const {
    const Range& faces = model_->objects[pair.object].faces;
    std::vector<std::uint32_t> candidates;
    if (broad_phase_ != BroadPhase::clipped) {
        candidates.resize(faces.count);
        std::iota(candidates.begin(), candidates.end(), faces.first);
        return candidates;
    }
    const AxisBox<Real>& other = bounding_boxes_[pair.other];
    for (std::uint32_t f = faces.first; f < faces.end(); ++f) {
        if (meet(face_boxes_[f], other)) candidates.push_back(f);
    }
    return candidates;
}

template <class Real>
void Collision<Real>::test_candidates(std::span<const Vec4<Real>> positions, std::size_t index) {
    const ObjectPair& pair = pairs_[index];
    const ObjectPair& mirror = pairs_[pair.mirror];
    const std::vector<std::uint32_t>& ours = candidates_[index];
    const std::vector<std::uint32_t>& theirs = candidates_[pair.mirror];
    std::vector<AxisBox<Real>> boxes;  // side by side: the inner loop reads nothing else
    for (const std::uint32_t face : theirs) boxes.push_back(face_boxes_[face]);

    const std::size_t grain = 1 + kTestsATask / (1 + theirs.size());
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, ours.size(), grain), [&](const auto& range) {
        for (std::size_t i = range.begin(); i < range.end(); ++i) {
            const AxisBox<Real> box = face_boxes_[ours[i]];
            const Triangle<Real> face = triangle(positions, model_->faces[ours[i]]);
            for (std::size_t j = 0; j < boxes.size(); ++j) {
                if (!meet(box, boxes[j])) continue;
                if (!triangles_overlap(face, triangle(positions, model_->faces[theirs[j]]))) continue;
                set_colliding(pair, ours[i]);
                set_colliding(mirror, theirs[j]);
            }
        }
    });
}

// Bits of one word belong to faces that several threads may find.
template <class Real>
void Collision<Real>::set_colliding(const ObjectPair& pair, std::uint32_t face) {
    const std::uint32_t index = face - model_->objects[pair.object].faces.first;
    std::atomic_ref(face_collisions_[pair.first_word + index / 32])
        .fetch_or(1u << (index % 32), std::memory_order_relaxed);
}

template <class Real>
Range Collision<Real>::row(std::uint32_t object) const {
    return {row_starts_[object], row_starts_[object + 1] - row_starts_[object]};
}

template <class Real>
bool Collision<Real>::collides(const ObjectPair& pair, std::uint32_t face) const {
    const std::uint32_t index = face - model_->objects[pair.object].faces.first;
    return (face_collisions_[pair.first_word + index / 32] >> (index % 32) & 1u) != 0;
}

template <class Real>
bool Collision<Real>::collides(std::uint32_t face) const {
    const Range pairs = row(model_->faces[face].object);
    for (std::uint32_t p = pairs.first; p < pairs.end(); ++p) {
        if (collides(pairs_[p], face)) return true;
    }
    return false;
}

template <class Real>
std::uint32_t Collision<Real>::count_colliding(std::uint32_t object) const {
    const Range& faces = model_->objects[object].faces;
    if (row(object).count == 0) return 0;
    std::uint32_t count = 0;
    for (std::uint32_t f = faces.first; f < faces.end(); ++f) count += collides(f) ? 1 : 0;
    return count;
}

template <class Real>
bool Collision<Real>::collide(const ObjectPair& pair) const {
    const auto first = face_collisions_.begin() + pair.first_word;
    return std::any_of(first, first + word_count(model_->objects[pair.object]),
                       [](std::uint32_t word) { return word != 0; });
}

template class Collision<float>;
template class Collision<double>;

}  // namespace gelatin::cpu
