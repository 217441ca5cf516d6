#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "cpu/implicit/find_pairs.h"
#include "cpu/implicit/rigid_bodies.h"
#include "cpu/nodes.h"
#include "model/contact/contact_surface.h"
#include "model/model.h"

namespace gelatin::cpu {

/// Lets nodes go to where a solver wants them, as far as no pair of surfaces crosses on the way.
///
/// Nodes go straight and at the same time, so a direction that separates the two sides of a pair at both ends
/// separates them all the way: the least height of one side less the most of the other is concave in time. A
/// pair that neither its direction at the start separates nor that at the end is clipped: each of its nodes
/// keeps to a half space that holds its share of the gap, in a frame that moves with what the bodies of an
/// island have in common. Handles and colliders whose motion bodies cannot make room for stay where they are.
template <class Real>
class Guard {
public:
    Guard(std::shared_ptr<const Model> model, std::shared_ptr<const ContactSurface> surface);

    /// @param pairs all that may cross while nodes keep to `paths`
    /// @param compliances of nodes [m/N], by which a gap is divided; 0: the node does not yield
    /// @param ends input: where nodes are wanted; output: where they go [m]
    /// @param is_blocked objects whose held nodes stay where they are; output: others, too, that would cross
    /// @param checked how many of the first pairs are known not to cross there
    /// @return surface nodes that do not keep to their paths: these may cross others; then find pairs of
    /// where they end, and run again
    std::vector<std::uint32_t> run(const Paths<Real>& paths, std::span<const NearPair<Real>> pairs,
                                   std::span<const Real> compliances, std::span<Vec4<Real>> ends,
                                   std::vector<std::uint8_t>& is_blocked, std::size_t checked = 0);

    /// Whether the last run moved any node.
    bool has_changed() const { return has_changed_; }
    /// Of all runs.
    std::size_t clipped_pairs() const { return clipped_count_; }

private:
    struct HalfSpace {
        std::uint32_t next;  // of the node's, or kNoNode
        Vec3<Real> normal;
        Real room;  // a displacement along the normal is at most this [m]
    };
    struct BesideCollider {
        Real least;  // distance where a node may end [m]
        HalfSpace space;
    };

    void move(const Paths<Real>& paths, std::span<const NearPair<Real>> pairs,
              std::span<const Real> compliances, std::span<Vec4<Real>> ends, std::size_t checked);
    void find_frames(const Paths<Real>& paths, std::span<const NearPair<Real>> pairs,
                     std::span<const Vec4<Real>> ends);
    Vec3<Real> outside_planes(Vec3<Real> frame) const;
    BesideCollider beside_collider(const Collider& collider, std::uint32_t node,
                                   const Paths<Real>& paths) const;
    void keep_outside_colliders(const Paths<Real>& paths, std::span<const Real> compliances,
                                std::span<Vec4<Real>> ends);
    bool is_apart(const NearPair<Real>& near, const Paths<Real>& paths,
                  std::span<const Vec4<Real>> ends) const;
    void clip(const NearPair<Real>& near, const Paths<Real>& paths, std::span<const Real> compliances,
              std::span<const Vec4<Real>> ends);
    void add(std::uint32_t node, const Vec3<Real>& normal, Real room);
    template <class Use>
    void for_spaces(std::uint32_t node, const Paths<Real>& paths, const Use& use) const;
    void place(std::uint32_t node, const Paths<Real>& paths, std::span<Vec4<Real>> ends);
    void place_body(std::uint32_t object, const Paths<Real>& paths, std::span<Vec4<Real>> ends);

    std::shared_ptr<const Model> model_;
    std::shared_ptr<const ContactSurface> surface_;
    RigidBodies<Real> rigid_bodies_;
    std::vector<Vec3<Real>> frames_;    // by object: what its island has in common [m]
    std::vector<Vec3<Real>> wanted_;    // displacements in the frame [m]
    std::vector<std::uint32_t> first_;  // half space of each node, or kNoNode
    std::vector<HalfSpace> half_spaces_;
    std::vector<std::uint8_t> is_changed_, is_frozen_;
    std::vector<std::uint8_t> is_clipped_;  // by pair
    bool has_changed_ = false;
    std::size_t clipped_count_ = 0;
};

}  // namespace gelatin::cpu
