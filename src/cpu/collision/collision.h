#pragma once

#include <memory>
#include <span>
#include <vector>

#include "cpu/collision/axis_box.h"
#include "cpu/collision/face_contact.h"
#include "cpu/collision/object_tree.h"
#include "gelatin/scene.h"
#include "model/model.h"

namespace gelatin::cpu {

/// A pair of objects that may touch, as seen from the first; each pair exists twice, once in either object's
/// row.
struct ObjectPair {
    std::uint32_t object, other;
    std::uint32_t mirror;      ///< index of the same pair as seen from the other object
    std::uint32_t first_word;  ///< index of its first bit in the Face Collision Result
};

/// Finds which faces of which objects touch (paper 2.4 and 3.1), stage by stage. The same result for any
/// number of threads. GPU twins: gpu::UpdateBoxes, gpu::FindObjectPairs, gpu::FindFaceCollisions.
template <class Real>
class Collision {
public:
    /// @param margin of the boxes; it affects what is tested, not which faces touch
    explicit Collision(std::shared_ptr<const Model> model, BroadPhase broad_phase = BroadPhase::hierarchy,
                       CollisionDetection detection = CollisionDetection::discrete,
                       const BoxMargin<Real>& margin = {});

    /// The box of each node and face of a surface, and of each object; with continuous detection over the
    /// whole step.
    /// @param previous the positions at its start, which discrete detection does not read
    void update_boxes(std::span<const Vec4<Real>> positions, std::span<const Vec4<Real>> previous = {});

    /// The pairs of objects that may touch, row by row, in the order of the others' indices.
    void find_object_pairs();

    /// Face against face in these pairs.
    void find_face_collisions(std::span<const Vec4<Real>> positions,
                              std::span<const Vec4<Real>> previous = {});

    const std::vector<AxisBox<Real>>& bounding_boxes() const { return bounding_boxes_; }
    const std::vector<AxisBox<Real>>& face_boxes() const { return face_boxes_; }
    /// For the nodes of Model::face_trees.
    const std::vector<AxisBox<Real>>& tree_boxes() const { return tree_boxes_; }
    const std::vector<ObjectPair>& pairs() const { return pairs_; }
    /// An object's pairs.
    Range row(std::uint32_t object) const;

    /// How a face of the pair's object touches the other object.
    FaceContact contact(const ObjectPair& pair, std::uint32_t face) const;
    bool collides(const ObjectPair& pair, std::uint32_t face) const {
        return contact(pair, face) != FaceContact::none;
    }
    /// True if it touches any other object.
    bool collides(std::uint32_t face) const;
    /// True if any faces of the pair's objects touch.
    bool collide(const ObjectPair& pair) const;

private:
    void update_tree(std::uint32_t object);
    void find_partners(std::uint32_t object);
    bool starts_tests(const ObjectPair& pair) const;
    std::vector<std::uint32_t> find_candidates(const ObjectPair& pair) const;
    template <class Found>
    void for_faces_near(const ObjectPair& pair, std::uint32_t face, const Found& found) const;
    template <class Test>
    void test_candidates(const ObjectPair& pair, const Test& test);
    void set_contact(const ObjectPair& pair, std::uint32_t face, FaceContact touch);

    std::shared_ptr<const Model> model_;
    BroadPhase broad_phase_;
    CollisionDetection detection_;
    BoxMargin<Real> margin_;
    std::vector<AxisBox<Real>> node_boxes_;      // shape [nodes]
    std::vector<AxisBox<Real>> face_boxes_;      // shape [faces]
    std::vector<AxisBox<Real>> tree_boxes_;      // of Model::face_trees; shape [nodes]
    std::vector<AxisBox<Real>> bounding_boxes_;  // shape [objects]
    ObjectTree<Real> object_tree_;
    std::vector<std::vector<std::uint32_t>> partners_;  // for each object, ascending
    std::vector<ObjectPair> pairs_;
    std::vector<std::uint32_t> row_starts_;       // shape [objects + 1]
    std::vector<std::uint32_t> face_collisions_;  // two bits a face of its object, by pair: a FaceContact
};

}  // namespace gelatin::cpu
