#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "cpu/contact/contact_aims.h"
#include "cpu/contact/contact_list.h"
#include "cpu/nodes.h"
#include "model/model.h"

namespace gelatin::cpu {

/// How near to each other a move may bring two surfaces.
enum class Closeness {
    guess,   ///< half of the reach, or of the gap, is left for what follows
    motion,  ///< a tenth of the gap
};

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
    /// @return false if movers may go farther after this move and another detection
    bool plan(const ContactList<Real>& list, const ContactAims<Real>& aims,
              std::span<const Vec4<Real>> positions, std::span<const Vec4<Real>> ends, Closeness closeness,
              Movers movers = Movers::objects);

    /// Leaves each object no more than a part of what its nodes were to make, and others what that leaves
    /// them. @pre nodes were planned @param parts by object
    void shorten(const ContactList<Real>& list, std::span<const Real> parts);

    /// Goes there. @param keeps_momentum whether what objects of an island did not make, all of it makes up
    /// for
    void go(ContactList<Real>& list, std::span<const Vec4<Real>> ends, bool keeps_momentum,
            std::span<Vec4<Real>> positions);

    /// Whether it was rooms that kept an object from the end of its planned motion.
    bool lacks_room() const {
        return std::any_of(room_parts_.begin(), room_parts_.end(), [](Real part) { return part < Real(1); });
    }

    /// The part of the planned motion that an object, or a node, makes.
    Real part(std::size_t mover) const { return parts_[mover]; }

private:
    void find_common_motions(const ContactList<Real>& list, std::span<const Vec4<Real>> positions,
                             std::span<const Vec4<Real>> ends);
    bool limit_common_motions(const ContactList<Real>& list);
    void keep_to_rooms(const ContactList<Real>& list, const ContactAims<Real>& aims,
                       std::span<const Vec4<Real>> positions, std::span<const Vec4<Real>> ends);
    void keep_pairs_apart(const ContactList<Real>& list);
    std::uint32_t island_of(const ContactList<Real>& list, std::uint32_t mover) const;

    // A pair that could come too near, along a direction from its first side to its second.
    struct Course {
        std::array<std::uint32_t, 4> movers;
        std::array<Real, 4> heights, motions;  // of its nodes, from the first one [m]
        Real least;                            // gap that must be left [m]
        std::uint32_t first_count;             // nodes of the first side

        bool approaches(std::size_t k) const { return k < first_count ? motions[k] > 0 : motions[k] < 0; }
        // The gap when each node makes a part of its motion. @param part of node k
        template <class Part>
        Real gap(const Part& part) const;
        Real gap_at(Real part) const {
            return gap([&](std::size_t) { return part; });
        }
        bool is_free() const { return gap_at(Real(1)) >= least; }
        // Whether the gap is left by all parts up to these: the worst is that nothing but what approaches
        // moves.
        template <class Part>
        bool stays_free(const Part& part) const;
    };

    void find_courses(const ContactList<Real>& list, const ContactAims<Real>& aims,
                      std::span<const Vec4<Real>> positions, std::span<const Vec4<Real>> ends,
                      Closeness closeness);
    bool are_far_apart(const ContactPair& pair, const ContactAims<Real>& aims, const PairAim<Real>& aim,
                       Closeness closeness) const;
    Course best_course(const ContactPair& pair, const PairAim<Real>& aim, Real reach,
                       const std::array<Vec3<Real>, 4>& nodes, const std::array<Vec3<Real>, 4>& motions,
                       Closeness closeness) const;
    Course course_along(const ContactPair& pair, const PairAim<Real>& aim, Real reach,
                        const Vec3<Real>& normal, const std::array<Vec3<Real>, 4>& nodes,
                        const std::array<Vec3<Real>, 4>& motions, Closeness closeness) const;

    std::shared_ptr<const Model> model_;
    std::vector<std::uint32_t> places_;     // of nodes among those of the surface
    std::vector<std::uint32_t> object_of_;  // by node
    std::vector<double> masses_;            // of objects [kg]
    std::vector<std::uint8_t> is_held_;     // by object
    std::vector<Vec3<Real>> means_;         // mean motion of each object [m]
    std::vector<Real> ways_;  // of surface nodes since the aim and now, without what is in common [m]
    std::vector<Real> ways_of_objects_;  // the longest of a node's now [m]
    std::vector<Vec3<Real>> common_;     // by island
    Movers movers_ = Movers::objects;
    std::vector<Real> parts_, next_parts_, room_parts_;  // by mover
    std::vector<Course> courses_;
    std::vector<std::vector<Course>> found_;  // of each task, in the order of the pairs
};

}  // namespace gelatin::cpu
