#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "cpu/contact/contact_aims.h"
#include "cpu/contact/contact_list.h"
#include "cpu/contact/own_guard.h"
#include "cpu/contact/pair_course.h"
#include "cpu/nodes.h"
#include "cpu/object_pieces.h"
#include "model/model.h"

namespace gelatin::cpu {

/// What makes parts of its own of a planned move.
enum class Movers {
    objects,  ///< besides what their islands have in common, which they move in full
    nodes,
};

/// Moves all bodies of a list at once towards where they should be. What the bodies of an island have in
/// common they move in full. Of the rest each object, or node, makes as much as leaves a gap in all of its
/// pairs, along a direction that separates them. All nodes go straight and at the same time, so that surfaces
/// that are apart at both ends are so on the way.
template <class Real>
class GuardedMove {
public:
    GuardedMove(std::shared_ptr<const Model> model, std::vector<std::uint32_t> places);

    /// To be called when a step begins. @param positions tell by their inverse masses which nodes are held
    void begin(std::span<const Vec4<Real>> positions);
    bool is_held(std::size_t object) const { return is_held_[object] != 0; }

    /// The mean motions of bodies to `ends` [m], until the next call.
    const std::vector<Vec3<Real>>& mean_motions(std::span<const Vec4<Real>> positions,
                                                std::span<const Vec4<Real>> ends);

    /// Moves islands near colliders along their courses, as far as their bodies' mean motion to `ends` leads
    /// and colliders let them.
    void drift(ContactList<Real>& list, const ContactAims<Real>& aims, std::span<const Vec4<Real>> ends,
               std::span<Vec4<Real>> positions);

    /// Finds how much of the way to `ends` each mover may go.
    /// @param ends if nodes are movers, output, too: in their rooms in their own bodies
    /// @param is_rigid by object: not 0 if its ends are a rigid motion; empty: none are
    /// @param is_final false: where rooms are in the way, no more than that is found, and there is no move
    /// @return false if movers may go farther after this move and another detection
    bool plan(const ContactList<Real>& list, const ContactAims<Real>& aims,
              std::span<const Vec4<Real>> positions, std::span<Vec4<Real>> ends, Closeness closeness,
              Movers movers = Movers::objects, std::span<const std::uint8_t> is_rigid = {},
              bool is_final = true);

    /// Whether all objects may make all of their way. If so, go() makes it.
    /// @pre nothing is listed
    bool reaches(const ContactList<Real>& list, const ContactAims<Real>& aims,
                 std::span<const Vec4<Real>> positions, std::span<const Vec4<Real>> ends);

    /// Leaves each object no more than a part of what its nodes were to make, and others what that leaves
    /// them. @pre nodes were planned, from and to the same positions @param parts by object
    void shorten(const ContactList<Real>& list, const ContactAims<Real>& aims,
                 std::span<const Vec4<Real>> positions, std::span<const Vec4<Real>> ends,
                 std::span<const Real> parts);

    /// Goes there. @param keeps_momentum whether what objects of an island did not make, all of it makes up
    /// for
    void go(ContactList<Real>& list, std::span<const Vec4<Real>> ends, bool keeps_momentum,
            std::span<Vec4<Real>> positions);

    /// Whether it was rooms that kept an object from the end of its planned motion.
    bool lacks_room() const { return count_kept() > 0; }

    /// How many objects rooms kept so.
    std::size_t count_kept() const {
        return static_cast<std::size_t>(
            std::count_if(room_parts_.begin(), room_parts_.end(), [](Real part) { return part < Real(1); }));
    }

    /// How much of a planned motion its rooms keep an object from [m].
    Real kept(std::size_t object) const { return (Real(1) - room_parts_[object]) * ways_of_objects_[object]; }

    /// Whether it was their rooms in themselves that kept bodies, or one.
    bool lacks_own_room() const { return own_.lacks_room(); }
    bool lacks_own_room(std::size_t object) const { return own_.lacks_room(object); }
    Real used_at_end(std::uint32_t object, const ContactList<Real>& list, std::uint32_t place,
                     const Vec3<Real>& end) const {
        return own_.used_at_end(object, list.own, place, end);
    }

    /// The part of the planned motion that an object, or a node, makes.
    Real part(std::size_t mover) const { return parts_[mover]; }

private:
    // Of nodes, the least part of their ways that rooms let them make, and the longest way, now and since the
    // aim [m].
    struct Reach {
        Real part = 1, way = 0, longest_way = 0;

        void join(const Reach& other) {
            part = std::min(part, other.part);
            way = std::max(way, other.way);
            longest_way = std::max(longest_way, other.longest_way);
        }
    };

    void find_common_motions(const ContactList<Real>& list, std::span<const Vec4<Real>> positions,
                             std::span<const Vec4<Real>> ends);
    bool limit_common_motions(const ContactList<Real>& list);
    void keep_to_rooms(const ContactList<Real>& list, const ContactAims<Real>& aims,
                       std::span<const Vec4<Real>> positions, std::span<const Vec4<Real>> ends);
    void keep_pairs_apart(const ContactList<Real>& list);
    void find_blocked(std::size_t task);
    bool shorten_blocked(bool makes_some);
    bool stop_blocked_islands(const ContactList<Real>& list);
    std::uint32_t island_of(const ContactList<Real>& list, std::uint32_t mover) const;

    void find_courses(const ContactList<Real>& list, const ContactAims<Real>& aims,
                      std::span<const Vec4<Real>> positions, std::span<const Vec4<Real>> ends,
                      Closeness closeness);
    bool are_far_apart(const ContactPair& pair, const ContactAims<Real>& aims, const PairAim<Real>& aim,
                       Closeness closeness) const;
    void keep_from_themselves(const ContactList<Real>& list, const ContactAims<Real>& aims,
                              std::span<const Vec4<Real>> positions, std::span<const Vec4<Real>> ends,
                              Closeness closeness, std::span<const std::uint8_t> is_rigid = {});
    bool plan_positions(std::uint32_t object, const Vec3<Real>& common, std::span<const Vec4<Real>> positions,
                        std::span<const Vec4<Real>> ends);
    Range movers_of(std::uint32_t object) const;
    bool makes_the_same(std::uint32_t object, const std::vector<Real>& parts) const;
    void scale_parts(std::span<const Real> by_object);

    std::shared_ptr<const Model> model_;
    std::vector<std::uint32_t> places_;     // of nodes among those of the surface
    std::vector<std::uint32_t> object_of_;  // by node
    ObjectPieces pieces_;                   // of nodes
    std::vector<double> masses_;            // of objects [kg]
    std::vector<std::uint8_t> is_held_;     // by object
    std::vector<Vec3<Real>> means_;         // mean motion of each object [m]
    std::vector<Real> ways_;  // of surface nodes since the aim and now, without what is in common [m]
    // Of each object the longest of these, and of a node's way now [m].
    std::vector<Real> longest_ways_, ways_of_objects_;
    std::vector<Vec3<Real>> common_;  // by island
    Movers movers_ = Movers::objects;
    std::vector<Real> parts_, next_parts_, room_parts_;  // by mover
    std::vector<std::uint8_t> is_concerned_;             // by mover: in a pair that the last round shortened
    OwnGuard<Real> own_;
    std::vector<Vec4<Real>> planned_;                     // where bodies that meet themselves go [m]
    std::vector<std::vector<PairCourse<Real>>> courses_;  // task by task, in the order of the pairs
    std::vector<std::vector<std::uint32_t>> blocked_;     // of these, the numbers within a task
};

}  // namespace gelatin::cpu
