#pragma once

#include <algorithm>
#include <cstdint>
#include <glm/mat3x3.hpp>
#include <limits>
#include <memory>
#include <span>
#include <vector>

#include "cpu/contact/contact_aims.h"
#include "cpu/contact/contact_list.h"
#include "cpu/contact/own_rooms.h"
#include "cpu/contact/pair_course.h"
#include "cpu/nodes.h"
#include "model/model.h"

namespace gelatin::cpu {

/// Keeps the bodies of a planned move from passing through themselves. Where a body goes, its map goes, too:
/// all nodes stay in their rooms on the way if they are in them at the end. Its own pairs have directions
/// that separate them all the way and may turn with the body.
template <class Real>
class OwnGuard {
public:
    explicit OwnGuard(std::shared_ptr<const Model> model);

    /// To be called when a move is planned.
    void begin() {
        std::fill(lacks_room_.begin(), lacks_room_.end(), std::uint8_t(0));
        std::fill(has_next_.begin(), has_next_.end(), std::uint8_t(0));
    }

    /// Whether all nodes of a body stay in their rooms on the way to `ends`. If so, go() takes its map there.
    bool reaches(std::uint32_t object, const OwnRooms<Real>& rooms, std::span<const Vec4<Real>> positions,
                 std::span<const Vec4<Real>> ends);

    /// Brings the ends of a body's free nodes into their rooms, as these are where the body ends.
    void bring_into_rooms(std::uint32_t object, const OwnRooms<Real>& rooms,
                          std::span<const Vec4<Real>> positions, std::span<Vec4<Real>> ends);

    /// The part of their motions that all nodes of a body may make: on which they stay in their rooms.
    /// @param ends of all nodes [m]
    Real part_in_rooms(std::uint32_t object, const OwnRooms<Real>& rooms,
                       std::span<const Vec4<Real>> positions, std::span<const Vec4<Real>> ends);
    /// On which the pairs of a body with itself stay apart.
    Real part_of_pairs(std::uint32_t object, const ContactList<Real>& list, const ContactAims<Real>& aims,
                       std::span<const Vec4<Real>> positions, std::span<const Vec4<Real>> ends,
                       Closeness closeness) const;
    /// A body moves rigidly: what is apart in it stays so.
    /// @return false if the map could not follow
    bool carry(std::uint32_t object, const OwnRooms<Real>& rooms, std::span<const Vec4<Real>> positions,
               std::span<const Vec4<Real>> ends);
    /// All nodes of the body make this part of what they were to make.
    void shorten(std::uint32_t object, Real part, const OwnRooms<Real>& rooms);
    /// The body makes nothing but a displacement.
    void stay(std::uint32_t object, const ContactList<Real>& list, const Vec3<Real>& displacement);

    /// Goes to the ends of the last part, which was 1, or as it stays. @param more displacement of all [m]
    void go(std::uint32_t object, const Vec3<Real>& more, ContactList<Real>& list);

    /// Whether its room kept a body from the end of its planned motion, and another look at it would help.
    bool lacks_room() const {
        return std::any_of(lacks_room_.begin(), lacks_room_.end(), [](auto lacks) { return lacks != 0; });
    }
    bool lacks_room(std::size_t object) const { return lacks_room_[object] != 0; }
    /// The part of its room that a surface node of such a body uses where the planned motion ends.
    Real used_at_end(std::uint32_t object, const OwnRooms<Real>& rooms, std::uint32_t place,
                     const Vec3<Real>& end) const {
        const std::uint32_t k = place - rooms.places(object).first;
        const MapAhead<Real>& next = next_[object];
        const Real used = glm::length(end - next.mapped[k]);
        return next.rooms[k] > Real(0) ? used / next.rooms[k] : std::numeric_limits<Real>::infinity();
    }

private:
    bool stays_in_rooms(std::uint32_t object, const OwnRooms<Real>& rooms, Real of_rooms,
                        std::span<const Vec4<Real>> positions, std::span<const Vec4<Real>> ends) const;
    Real part_of_pair(const ContactPair& pair, const PairAim<Real>& aim, const ContactAims<Real>& aims,
                      std::span<const Vec4<Real>> positions, std::span<const Vec4<Real>> ends,
                      Closeness closeness) const;

    std::shared_ptr<const Model> model_;
    std::vector<MapAhead<Real>> next_;                 // by object
    std::vector<std::uint8_t> lacks_room_, has_next_;  // by object; whether its end is known already
};

}  // namespace gelatin::cpu
