#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "cpu/collision/collision.h"
#include "cpu/collision/object_tree.h"
#include "cpu/contact/contact_list.h"
#include "model/contact/contact_surface.h"
#include "model/model.h"

namespace gelatin::cpu {

/// Pairs are listed that may come nearer than this times the reach.
constexpr double kListedReach = 3.0;

/// What is expected to happen after a detection.
template <class Real>
struct Expected {
    std::span<const Vec4<Real>> ends = {};     ///< of nodes [m], or empty: they stay
    std::span<const Vec3<Real>> motions = {};  ///< means of bodies [m], or empty: none
    std::span<const std::uint8_t> stays = {};  ///< by body: not 0 if it is held, or presses a collider
    double longest = 0.0;                      ///< motion of a node in a step [m]
};

/// An object as one near it sees it.
template <class Real>
struct NearObject {
    Real squared;  ///< distance between their boxes [m^2]
    std::uint32_t object;
    Real spare;        ///< NearObjects::spare_margin [m]
    Vec3<Real> drift;  ///< NearObjects::drift_towards it [m]
};

/// Which objects are near each other, in which islands, and what islands do (docs/contact.md).
template <class Real>
class NearObjects {
public:
    /// @param collision has the boxes of faces, with a margin of half the listed distance; must outlive it
    NearObjects(std::shared_ptr<const Model> model, const ContactSurface& surface,
                const Collision<Real>& collision);

    /// The greatest distance up to which pairs of any two objects are listed [m].
    static double most_listed(const ContactSurface& surface);

    /// Writes the list's islands and their courses. @param positions must stay until the next run
    void run(std::span<const Vec4<Real>> positions, const Expected<Real>& expected, ContactList<Real>& list);
    /// Sorts what is near an object, once the boxes of faces are those of this run.
    /// @param most distance up to which by_distance() is wanted, beyond what is listed [m]
    void sort(Real most);

    /// Beyond what is listed [m]: islands are farther apart.
    double island_distance() const { return island_distance_; }
    /// Objects that an object meets if both go their ways, ascending; not one collider and another.
    const std::vector<NearObject<Real>>& meeting(std::uint32_t object) const { return meeting_[object]; }
    /// Those that are nearer to it than sort() was told, the nearest first.
    const std::vector<NearObject<Real>>& by_distance(std::uint32_t object) const {
        return by_distance_[object];
    }

    /// By body: whether it comes near enough to another object to press it, as boxes of bodies that go
    /// straight tell. Beside colliders it may. @param motions of bodies [m]
    std::vector<std::uint8_t> find_meeting(std::span<const Vec4<Real>> positions,
                                           std::span<const Vec3<Real>> motions) const;

    /// What an object's island does [m].
    const Vec3<Real>& drift(std::uint32_t object) const { return drifts_[object]; }
    /// The same as another object sees it. Bodies of one island go together.
    Vec3<Real> drift_towards(std::uint32_t object, std::uint32_t other) const;

    /// How thick an object is for what is listed [m]: a collider that moves needs room, too.
    double listed_thickness(std::size_t object) const { return listed_thicknesses_[object]; }
    /// Up to here pairs of two objects are listed [m].
    double listed(std::uint32_t object, std::uint32_t other) const {
        return kListedReach * (listed_thicknesses_[object] + listed_thicknesses_[other]);
    }
    /// Boxes have the margin of the thickest bodies: by how much that is too much for two objects [m].
    Real spare_margin(std::uint32_t object, std::uint32_t other) const;

    /// No more than the square of the distance between what is in a body's box, anywhere on its drift, and
    /// the faces of a collider's leaf, beyond what is listed [m^2]. These can be large, and their boxes far
    /// larger.
    Real squared_gap(const AxisBox<Real>& box, const Vec3<Real>& drift, std::uint32_t leaf) const;

private:
    std::vector<AxisBox<Real>> boxes_at(std::span<const Vec4<Real>> positions) const;
    void find_near_objects();
    bool reaches(std::uint32_t collider, const AxisBox<Real>& box, Real most) const;
    void find_islands(ContactList<Real>& list);
    void find_drifts(const Expected<Real>& expected, ContactList<Real>& list);

    std::shared_ptr<const Model> model_;
    const Collision<Real>& collision_;
    double listed_;  // greatest of all [m]
    BoxMargin<Real> margin_;
    std::vector<double> listed_thicknesses_;
    std::span<const Vec4<Real>> positions_;  // of this run
    double island_distance_ = 0.0;
    std::vector<AxisBox<Real>> boxes_;  // of objects where they are
    std::vector<Vec3<Real>> drifts_;    // by object
    ObjectTree<Real> object_tree_;
    // Of each object, those near it that are not both colliders: those of a body's island, and colliders.
    std::vector<std::vector<std::uint32_t>> near_;
    std::vector<std::vector<NearObject<Real>>> meeting_, by_distance_;
};

}  // namespace gelatin::cpu
