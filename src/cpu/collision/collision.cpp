#include "cpu/collision/collision.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <utility>

#include "cpu/collision/time_of_impact.h"
#include "cpu/collision/triangle_overlap.h"
#include "cpu/collision/walk_tree.h"
#include "model/collision/face_collision_words.h"
#include "model/for_each_index.h"

namespace gelatin::cpu {
namespace {

constexpr std::uint32_t kFacesATask = 2048;
constexpr std::uint32_t kTestsATask = 65536;
constexpr std::size_t kWalksATask = 64;

std::uint32_t word_count(const ModelObject& object) {
    return face_collision_words(object.faces.count);
}

template <class Real>
Triangle<Real> triangle(std::span<const Vec4<Real>> positions, const Face& face) {
    return {Vec3<Real>(positions[face.a]), Vec3<Real>(positions[face.b]), Vec3<Real>(positions[face.c])};
}

}  // namespace

template <class Real>
Collision<Real>::Collision(std::shared_ptr<const Model> model, BroadPhase broad_phase,
                           CollisionDetection detection, const BoxMargin<Real>& margin)
    : model_(std::move(model)),
      broad_phase_(broad_phase),
      detection_(detection),
      margin_(margin),
      node_boxes_(model_->node_count()),
      face_boxes_(model_->faces.size()),
      tree_boxes_(model_->face_trees.nodes.size()),
      bounding_boxes_(model_->objects.size()),
      object_tree_(static_cast<std::uint32_t>(model_->objects.size())),
      partners_(model_->objects.size()),
      row_starts_(model_->objects.size() + 1) {}

template <class Real>
void Collision<Real>::update_boxes(std::span<const Vec4<Real>> positions,
                                   std::span<const Vec4<Real>> previous) {
    const bool continuous = detection_ == CollisionDetection::continuous;
    const std::vector<std::uint32_t>& nodes = model_->surface_parts.nodes;
    for_each_index(nodes.size(), [&](std::size_t s) {
        const std::uint32_t n = nodes[s];
        AxisBox<Real> box;
        box.add(Vec3<Real>(positions[n]), margin_);
        if (continuous) box.add(Vec3<Real>(previous[n]), margin_);
        node_boxes_[n] = box;
    });
    const auto faces = static_cast<std::uint32_t>(model_->faces.size());
    tbb::parallel_for(tbb::blocked_range<std::uint32_t>(0, faces, kFacesATask), [&](const auto& range) {
        for (std::uint32_t f = range.begin(); f < range.end(); ++f) {
            const Face& face = model_->faces[f];
            AxisBox<Real> box = node_boxes_[face.a];
            box.add(node_boxes_[face.b]);
            box.add(node_boxes_[face.c]);
            face_boxes_[f] = box;
        }
    });
    const auto objects = static_cast<std::uint32_t>(model_->objects.size());
    tbb::parallel_for(std::uint32_t(0), objects, [&](std::uint32_t o) { update_tree(o); });
}

template <class Real>
void Collision<Real>::update_tree(std::uint32_t object) {
    const std::uint32_t root = model_->face_trees.roots[object];
    update_tree_boxes<Real>(model_->face_trees, root, face_boxes_, tree_boxes_);
    bounding_boxes_[object] = tree_boxes_[root];
}

template <class Real>
void Collision<Real>::find_object_pairs() {
    const auto count = static_cast<std::uint32_t>(model_->objects.size());
    if (broad_phase_ == BroadPhase::hierarchy) object_tree_.update(bounding_boxes_);
    tbb::parallel_for(std::uint32_t(0), count, [&](std::uint32_t o) { find_partners(o); });

    pairs_.clear();
    std::uint32_t words = 0;
    for (std::uint32_t o = 0; o < count; ++o) {
        row_starts_[o] = static_cast<std::uint32_t>(pairs_.size());
        for (const std::uint32_t partner : partners_[o]) {
            pairs_.push_back({o, partner, 0, words});
            words += word_count(model_->objects[o]);
        }
    }
    row_starts_[count] = static_cast<std::uint32_t>(pairs_.size());

    // Pairs are in the order of (object, other). So those that name an object as the other one are in the
    // order of its own row.
    std::vector<std::uint32_t> next(row_starts_.begin(), row_starts_.end() - 1);
    for (ObjectPair& pair : pairs_) pair.mirror = next[pair.other]++;
    face_collisions_.assign(words, 0);
}

template <class Real>
void Collision<Real>::find_partners(std::uint32_t object) {
    std::vector<std::uint32_t>& partners = partners_[object];
    partners.clear();
    const auto add = [&](std::uint32_t other) {
        if (other != object) partners.push_back(other);
    };
    if (broad_phase_ == BroadPhase::hierarchy) {
        object_tree_.for_objects_near(bounding_boxes_[object], add);
        std::sort(partners.begin(), partners.end());
        return;
    }
    for (std::uint32_t other = 0; other < bounding_boxes_.size(); ++other) {
        if (broad_phase_ == BroadPhase::none || meet(bounding_boxes_[object], bounding_boxes_[other]))
            add(other);
    }
}

template <class Real>
void Collision<Real>::find_face_collisions(std::span<const Vec4<Real>> positions,
                                           std::span<const Vec4<Real>> previous) {
    const auto overlap = [&](const Face& a, const Face& b) {
        const bool touch = triangles_overlap(triangle(positions, a), triangle(positions, b));
        return touch ? FaceContacts{FaceContact::enters, FaceContact::enters} : FaceContacts{};
    };
    const auto touch_on_the_way = [&](const Face& a, const Face& b) {
        const Moving<Real, 3> face{triangle(previous, a), triangle(positions, a)},
            other{triangle(previous, b), triangle(positions, b)};
        return time_of_impact(face, other) ? face_contacts(face, other) : FaceContacts{};
    };
    tbb::parallel_for(std::size_t(0), pairs_.size(), [&](std::size_t p) {
        if (!starts_tests(pairs_[p])) return;
        if (detection_ == CollisionDetection::continuous) {
            test_candidates(pairs_[p], touch_on_the_way);
        } else {
            test_candidates(pairs_[p], overlap);
        }
    });
}

// A pair is tested once, from the object with fewer faces.
template <class Real>
bool Collision<Real>::starts_tests(const ObjectPair& pair) const {
    const std::uint32_t ours = model_->objects[pair.object].faces.count,
                        theirs = model_->objects[pair.other].faces.count;
    return ours < theirs || (ours == theirs && pair.object < pair.other);
}

template <class Real>
std::vector<std::uint32_t> Collision<Real>::find_candidates(const ObjectPair& pair) const {
    const Range& faces = model_->objects[pair.object].faces;
    std::vector<std::uint32_t> candidates;
    for (std::uint32_t f = faces.first; f < faces.end(); ++f) {
        if (broad_phase_ != BroadPhase::hierarchy || meet(face_boxes_[f], bounding_boxes_[pair.other]))
            candidates.push_back(f);
    }
    return candidates;
}

// found(other face) for each face of the other object whose box meets that of `face`.
template <class Real>
template <class Found>
void Collision<Real>::for_faces_near(const ObjectPair& pair, std::uint32_t face, const Found& found) const {
    const AxisBox<Real> box = face_boxes_[face];
    const auto test_face = [&](std::uint32_t f) {
        if (meet(box, face_boxes_[f])) found(f);
    };
    if (broad_phase_ == BroadPhase::hierarchy) {
        const BoxTree& trees = model_->face_trees;
        return for_items_near<Real>(trees, tree_boxes_, trees.roots[pair.other], box, test_face);
    }
    const Range& all = model_->objects[pair.other].faces;
    for (std::uint32_t f = all.first; f < all.end(); ++f) test_face(f);
}

template <class Real>
template <class Test>
void Collision<Real>::test_candidates(const ObjectPair& pair, const Test& test) {
    const std::vector<std::uint32_t> candidates = find_candidates(pair);
    const bool brute_force = broad_phase_ != BroadPhase::hierarchy;
    const std::size_t grain =
        brute_force ? 1 + kTestsATask / model_->objects[pair.other].faces.count : kWalksATask;
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, candidates.size(), grain), [&](const auto& range) {
        for (std::size_t i = range.begin(); i < range.end(); ++i) {
            const Face& face = model_->faces[candidates[i]];
            for_faces_near(pair, candidates[i], [&](std::uint32_t other) {
                const FaceContacts touches = test(face, model_->faces[other]);
                if (touches.ours == FaceContact::none) return;
                set_contact(pair, candidates[i], touches.ours);
                set_contact(pairs_[pair.mirror], other, touches.theirs);
            });
        }
    });
}

// Bits of one word belong to faces that several threads may find.
template <class Real>
void Collision<Real>::set_contact(const ObjectPair& pair, std::uint32_t face, FaceContact touch) {
    const std::uint32_t index = face - model_->objects[pair.object].faces.first;
    std::atomic_ref(face_collisions_[pair.first_word + index / kFacesAWord])
        .fetch_or(static_cast<std::uint32_t>(touch) << (2 * (index % kFacesAWord)),
                  std::memory_order_relaxed);
}

template <class Real>
FaceContact Collision<Real>::contact(const ObjectPair& pair, std::uint32_t face) const {
    const std::uint32_t index = face - model_->objects[pair.object].faces.first;
    return FaceContact(
        face_collisions_[pair.first_word + index / kFacesAWord] >> (2 * (index % kFacesAWord)) & 3u);
}

template <class Real>
Range Collision<Real>::row(std::uint32_t object) const {
    return {row_starts_[object], row_starts_[object + 1] - row_starts_[object]};
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
bool Collision<Real>::collide(const ObjectPair& pair) const {
    const auto first = face_collisions_.begin() + pair.first_word;
    return std::any_of(first, first + word_count(model_->objects[pair.object]),
                       [](std::uint32_t word) { return word != 0; });
}

template class Collision<float>;
template class Collision<double>;

}  // namespace gelatin::cpu
