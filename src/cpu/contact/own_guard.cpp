#include "cpu/contact/own_guard.h"

#include <algorithm>
#include <array>
#include <glm/geometric.hpp>
#include <utility>

namespace gelatin::cpu {
namespace {

// Of the part that seems to be allowed: it is found for all of the motion, whose map is another one.
constexpr double kSafe = 0.9;
// Of their rooms, what nodes of a guess may use. What is not listed does not come to press there, and nodes
// that others stop can stay behind.
constexpr double kOfRooms = 0.75;
// Rooms that a body would have if it was looked at have to let it make so much more of its motion.
constexpr double kWorthALook = 1.5;

template <class Real>
Real safe(Real part) {
    return part < Real(1) ? static_cast<Real>(kSafe) * part : part;
}

}  // namespace

template <class Real>
OwnGuard<Real>::OwnGuard(std::shared_ptr<const Model> model)
    : model_(std::move(model)),
      next_(model_->objects.size()),
      lacks_room_(model_->objects.size()),
      has_next_(model_->objects.size()) {}

template <class Real>
bool OwnGuard<Real>::reaches(std::uint32_t object, const OwnRooms<Real>& rooms,
                             std::span<const Vec4<Real>> positions, std::span<const Vec4<Real>> ends) {
    const auto stays = [&] { return stays_in_rooms(object, rooms, Real(1), positions, ends); };
    next_[object] = rooms.moved(object, positions, ends);
    if (stays()) return true;
    next_[object] = rooms.fitted(object, ends);
    if (stays()) return true;
    lacks_room_[object] = 1;
    return false;
}

// With the next map at the end of the way. @param of_rooms the part of these that nodes may use there
template <class Real>
bool OwnGuard<Real>::stays_in_rooms(std::uint32_t object, const OwnRooms<Real>& rooms, Real of_rooms,
                                    std::span<const Vec4<Real>> positions,
                                    std::span<const Vec4<Real>> ends) const {
    const Range& places = rooms.places(object);
    const MapAhead<Real>& next = next_[object];
    for (std::uint32_t k = 0; k < places.count; ++k) {
        const std::uint32_t s = places.first + k, n = model_->surface_parts.nodes[s];
        if (glm::length(rooms.deviation(s, Vec3<Real>(positions[n]))) > rooms.radius(s)) return false;
        if (glm::length(Vec3<Real>(ends[n]) - next.mapped[k]) > of_rooms * next.rooms[k]) return false;
    }
    return rooms.part_between(object, next.map) == Real(1);
}

// The present map is moved as the body is on the whole. Where that is not enough, a map is fitted to the
// ends. Then few nodes are out of their rooms: those that are stopped while what is beside them goes on. The
// whole body would make hardly any of its guess because of them.
template <class Real>
void OwnGuard<Real>::bring_into_rooms(std::uint32_t object, const OwnRooms<Real>& rooms,
                                      std::span<const Vec4<Real>> positions, std::span<Vec4<Real>> ends) {
    const Range& places = rooms.places(object);
    MapAhead<Real>& next = next_[object];
    const auto end_at = [&](std::uint32_t k) -> Vec4<Real>& {
        return ends[model_->surface_parts.nodes[places.first + k]];
    };
    const auto radius = [&](std::uint32_t k) { return static_cast<Real>(kOfRooms) * next.rooms[k]; };
    has_next_[object] = 1;
    next = rooms.moved(object, positions, ends);
    if (stays_in_rooms(object, rooms, static_cast<Real>(kOfRooms), positions, ends)) return;
    next = rooms.fitted(object, ends);
    const Real part = rooms.part_between(object, next.map);
    if (part < Real(1)) next = rooms.between(object, next.map, safe(part));
    for (std::uint32_t k = 0; k < places.count; ++k) {
        Vec4<Real>& end = end_at(k);
        const Vec3<Real> deviation = Vec3<Real>(end) - next.mapped[k];
        const Real length = glm::length(deviation);
        if (end.w > Real(0) && length > radius(k))
            end = Vec4<Real>(next.mapped[k] + radius(k) / length * deviation, end.w);
    }
}

// Of maps to the ends, the first with which nodes stay in their rooms, or the best.
template <class Real>
Real OwnGuard<Real>::part_in_rooms(std::uint32_t object, const OwnRooms<Real>& rooms,
                                   std::span<const Vec4<Real>> positions, std::span<const Vec4<Real>> ends) {
    const Range& places = rooms.places(object);
    Real anew = 1;  // what they could make from the middles of their rooms
    const auto part_with = [&](const MapAhead<Real>& ahead) {
        Real part = rooms.part_between(object, ahead.map);
        anew = 1;
        for (std::uint32_t k = 0; k < places.count; ++k) {
            const std::uint32_t s = places.first + k, n = model_->surface_parts.nodes[s];
            const Vec3<Real> before = rooms.deviation(s, Vec3<Real>(positions[n])),
                             after = Vec3<Real>(ends[n]) - ahead.mapped[k];
            const Real radius = std::min(ahead.rooms[k], rooms.radius(s));
            const bool stays = glm::length(after) <= ahead.rooms[k] && glm::length(before) <= rooms.radius(s);
            if (!stays) part = std::min(part, part_within(before, after - before, radius));
            anew = std::min(anew, part_within(Vec3<Real>(0), after - before, rooms.fresh_radius(s)));
        }
        return part;
    };
    Real best = -1;
    const auto holds = [&](MapAhead<Real> ahead) {
        const Real part = part_with(ahead);
        if (part > best) {
            best = part;
            next_[object] = std::move(ahead);
        }
        return best == Real(1);
    };
    const bool has_next = has_next_[object] != 0;
    if (has_next && holds(next_[object])) return best;
    if (holds(rooms.moved(object, positions, ends))) return best;
    if (has_next && holds(rooms.fitted(object, ends))) return best;
    if (anew > static_cast<Real>(kWorthALook) * best) lacks_room_[object] = 1;
    return safe(best);
}

template <class Real>
Real OwnGuard<Real>::part_of_pairs(std::uint32_t object, const ContactList<Real>& list,
                                   const ContactAims<Real>& aims, std::span<const Vec4<Real>> positions,
                                   std::span<const Vec4<Real>> ends, Closeness closeness) const {
    Real part = 1;
    for (std::uint32_t k = list.own_starts[object]; k < list.own_starts[object + 1]; ++k) {
        const std::uint32_t p = list.own_pairs[k];
        part = std::min(part, part_of_pair(list.pairs[p], aims.aims()[p], aims, positions, ends, closeness));
    }
    return safe(part);
}

template <class Real>
bool OwnGuard<Real>::carry(std::uint32_t object, const OwnRooms<Real>& rooms,
                           std::span<const Vec4<Real>> positions, std::span<const Vec4<Real>> ends) {
    next_[object] = rooms.moved(object, positions, ends);
    return rooms.part_between(object, next_[object].map) == Real(1);
}

template <class Real>
void OwnGuard<Real>::shorten(std::uint32_t object, Real part, const OwnRooms<Real>& rooms) {
    next_[object] = rooms.between(object, next_[object].map, part);
    has_next_[object] = 1;
}

// All nodes of a body make the same part of their motions.
template <class Real>
Real OwnGuard<Real>::part_of_pair(const ContactPair& pair, const PairAim<Real>& aim,
                                  const ContactAims<Real>& aims, std::span<const Vec4<Real>> positions,
                                  std::span<const Vec4<Real>> ends, Closeness closeness) const {
    std::array<Vec3<Real>, 4> nodes, moved;
    Real change = 0;  // of distances since the aim, now and at the end
    for (std::size_t c = 0; c < 4; ++c) {
        const std::uint32_t n = pair.nodes[c], first = pair.nodes[0];
        nodes[c] = Vec3<Real>(positions[n]);
        moved[c] = Vec3<Real>(ends[n]);
        const Vec3<Real> aimed = aims.nodes().aimed_at(n) - aims.nodes().aimed_at(first);
        change = std::max(
            {change, glm::length(nodes[c] - nodes[0] - aimed), glm::length(moved[c] - moved[0] - aimed)});
    }
    const Real reach(pair.reach);
    if (aim.gap - Real(2) * change > least_gap(aim, reach, aim.gap, closeness)) return Real(1);
    return part_apart(pair, aim, reach, nodes, moved, closeness);
}

template <class Real>
void OwnGuard<Real>::stay(std::uint32_t object, const ContactList<Real>& list,
                          const Vec3<Real>& displacement) {
    next_[object] = list.own.displaced(object, displacement);
}

template <class Real>
void OwnGuard<Real>::go(std::uint32_t object, const Vec3<Real>& more, ContactList<Real>& list) {
    next_[object].displace(more);
    list.own.follow(object, next_[object]);
}

template class OwnGuard<float>;
template class OwnGuard<double>;

}  // namespace gelatin::cpu
