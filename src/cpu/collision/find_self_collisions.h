#pragma once

#include <memory>
#include <span>
#include <vector>

#include "cpu/collision/affine_fit.h"
#include "cpu/collision/collision.h"
#include "cpu/collision/triangle_overlap.h"
#include "cpu/collision/walk_tree.h"
#include "model/corners.h"
#include "model/model.h"

namespace gelatin::cpu {

/// Finds which faces of an object touch other faces of the same object, except those that share a corner.
///
/// Two faces cannot touch while both are calm: nearer to where an affine map of the rest shape places them
/// than half of their clearance at rest after that map (docs/collision.md). Only faces that are not calm walk
/// through their object's tree. Only objects that their last map does not explain are tested face by face.
/// GPU twin: gpu::FindSelfCollisions.
template <class Real>
class FindSelfCollisions {
public:
    /// @pre the model has rest shapes @param boxes must outlive this
    FindSelfCollisions(std::shared_ptr<const Model> model, const Collision<Real>& boxes);

    /// @pre the boxes are those of `positions`
    void run(std::span<const Vec4<Real>> positions);

    /// The number of faces of its own object that a face touches.
    std::uint32_t contact_count(std::uint32_t face) const { return contact_counts_[face]; }
    bool collides(std::uint32_t face) const { return contact_counts_[face] > 0; }
    /// True if any face touches another one.
    bool any() const { return any_; }
    /// Faces that were not calm.
    std::size_t restless_count() const { return restless_.size(); }

    /// found(other) for each of the faces that `face` touches, in a fixed order. @pre `face` touches some
    template <class Found>
    void for_contacts(std::span<const Vec4<Real>> positions, std::uint32_t face, const Found& found) const {
        if (!collides(face)) return;
        for_faces_near(face, [&](std::uint32_t other) {
            if (collides(other) && touch(positions, face, other)) found(other);
        });
    }

private:
    void find_restless(std::span<const Vec4<Real>> positions);
    bool renew_fit(std::uint32_t object, std::span<const Vec4<Real>> positions);
    bool is_calm_all_over(std::uint32_t object, std::span<const Vec4<Real>> positions) const;
    bool is_face_calm(std::uint32_t index, std::span<const Vec4<Real>> positions) const;
    bool touch(std::span<const Vec4<Real>> positions, std::uint32_t face, std::uint32_t other) const;

    // found(other) for each face of the same object whose box meets that of `face`, and which shares no
    // corner with it.
    template <class Found>
    void for_faces_near(std::uint32_t face, const Found& found) const {
        const AxisBox<Real> box = boxes_.face_boxes()[face];
        const std::vector<Face>& faces = model_->faces;
        const std::uint32_t root = model_->face_trees.roots[faces[face].object];
        for_items_near<Real>(model_->face_trees, boxes_.tree_boxes(), root, box, [&](std::uint32_t other) {
            if (meet(box, boxes_.face_boxes()[other]) && !share_corner(faces[face], faces[other]))
                found(other);
        });
    }

    std::shared_ptr<const Model> model_;
    const Collision<Real>& boxes_;
    std::vector<AffineFit<Real>> fits_;          // shape [objects]
    std::vector<std::uint8_t> is_object_calm_;   // all faces are calm, shape [objects]
    std::vector<std::uint8_t> is_calm_;          // for objects that are not, shape [faces]
    std::vector<std::uint32_t> restless_;        // faces, ascending
    std::vector<std::uint32_t> contact_counts_;  // shape [faces]
    bool any_ = false;
};

}  // namespace gelatin::cpu
