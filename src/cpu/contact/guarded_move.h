#pragma once

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

/// Moves all bodies of a list at once towards where they should be. What the bodies of an island have in
/// common they move in full. Of the rest each makes as much as leaves a gap in all of its pairs, along the
/// directions in which they were aimed. All nodes go straight and at the same time, so that surfaces that are
/// apart at both ends are so on the way.
template <class Real>
class GuardedMove {
public:
    GuardedMove(std::shared_ptr<const Model> model, std::vector<std::uint32_t> places);

    /// To be called when a step begins. @param positions tell by their inverse masses which nodes are held
    void begin(std::span<const Vec4<Real>> positions);
    bool is_held(std::size_t object) const { return is_held_[object] != 0; }

    /// Finds how much of the way to `ends` each object may go.
    /// @return false if more room, or a new island, would let an object go farther
    bool plan(const ContactList<Real>& list, const ContactAims<Real>& aims,
              std::span<const Vec4<Real>> positions, std::span<const Vec4<Real>> ends, Closeness closeness);

    /// Goes there. @param keeps_momentum whether what objects of an island did not make, all of it makes up
    /// for
    void go(ContactList<Real>& list, std::span<const Vec4<Real>> ends, bool keeps_momentum,
            std::span<Vec4<Real>> positions);

    /// The part of the planned motion that an object makes.
    Real part(std::size_t object) const { return parts_[object]; }

private:
    void find_common_motions(const ContactList<Real>& list, std::span<const Vec4<Real>> positions,
                             std::span<const Vec4<Real>> ends);
    bool limit_common_motions(const ContactList<Real>& list);
    void keep_to_rooms(const ContactList<Real>& list, const ContactAims<Real>& aims,
                       std::span<const Vec4<Real>> positions, std::span<const Vec4<Real>> ends);
    void find_blocked_pairs(const ContactList<Real>& list, const ContactAims<Real>& aims,
                            std::span<const Vec4<Real>> positions, std::span<const Vec4<Real>> ends,
                            Closeness closeness);
    void keep_pairs_apart(const ContactList<Real>& list);

    // A pair that could come too near, along a direction that separates it from its first node.
    struct Course {
        std::uint32_t object, other, first_count;
        std::array<Real, 4> heights, motions;  // [m]
        Real least;                            // gap that must be left [m]
        Real gap(Real part, Real other_part) const;
        bool is_free() const { return gap(Real(1), Real(1)) >= least; }
    };

    Course course_along(const ContactPair& pair, const PairAim<Real>& aim, Real reach,
                        const Vec3<Real>& normal, const std::array<Vec3<Real>, 4>& nodes,
                        const std::array<Vec3<Real>, 4>& motions, Closeness closeness) const;

    std::shared_ptr<const Model> model_;
    std::vector<std::uint32_t> places_;  // of nodes among those of the surface
    std::vector<double> masses_;         // of objects [kg]
    std::vector<std::uint8_t> is_held_;  // by object
    std::vector<Vec3<Real>> means_;      // mean motion of each object [m]
    std::vector<Real> ways_;          // of surface nodes since the aim and now, without what is in common [m]
    std::vector<Vec3<Real>> common_;  // by island
    std::vector<Real> parts_, next_parts_, room_parts_;
    std::vector<std::uint32_t> blocked_;
    std::vector<Course> courses_;
};

}  // namespace gelatin::cpu
