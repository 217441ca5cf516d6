#include "cpu/contact/own_guard.h"

#include <algorithm>
#include <array>
#include <glm/geometric.hpp>
#include <utility>

namespace gelatin::cpu {
namespace {

// Of the part that seems to be allowed: it is found for all of the motion, whose map is another one.
constexpr double kSafe = 0.9;
// Rooms that a body would have if it was looked at have to let it make so much more of its motion.
constexpr double kWorthALook = 1.5;

}  // namespace

template <class Real>
OwnGuard<Real>::OwnGuard(std::shared_ptr<const Model> model)
    : model_(std::move(model)),
      next_(model_->objects.size()),
      lacks_room_(model_->objects.size()),
      is_shortened_(model_->objects.size()) {}

template <class Real>
Real OwnGuard<Real>::part(std::uint32_t object, const ContactList<Real>& list, const ContactAims<Real>& aims,
                          std::span<const Vec4<Real>> positions, std::span<const Vec4<Real>> ends,
                          Closeness closeness) {
    Real part = keep_to_rooms(object, list.own, positions, ends);
    for (std::uint32_t k = list.own_starts[object]; k < list.own_starts[object + 1]; ++k) {
        const std::uint32_t p = list.own_pairs[k];
        part = std::min(part, part_of_pair(list.pairs[p], aims.aims()[p], aims, positions, ends, closeness));
    }
    return part < Real(1) ? Real(kSafe) * part : part;
}

// Of maps to the ends, the first with which nodes stay in their rooms, or the best. Where the motion was
// shortened, the map to its ends is; else the present one is carried, and bent where that is not enough.
template <class Real>
Real OwnGuard<Real>::keep_to_rooms(std::uint32_t object, const OwnRooms<Real>& rooms,
                                   std::span<const Vec4<Real>> positions, std::span<const Vec4<Real>> ends) {
    const Range& places = rooms.places(object);
    Real anew = 1;  // what they could make from the middles of their rooms
    const auto part_with = [&](const ShapeMap<Real>& map) {
        Real part = rooms.part_between(object, map);
        anew = 1;
        for (std::uint32_t s = places.first; s < places.end(); ++s) {
            const std::uint32_t n = model_->surface_parts.nodes[s];
            const Vec3<Real> before = rooms.deviation(s, Vec3<Real>(positions[n])),
                             after = Vec3<Real>(ends[n]) - rooms.mapped(object, map, s);
            const Real radius = rooms.radius(object, map, s);
            const bool stays = glm::length(after) <= radius && glm::length(before) <= rooms.radius(s);
            if (!stays)
                part = std::min(part, part_within(before, after - before, std::min(radius, rooms.radius(s))));
            anew = std::min(anew, part_within(Vec3<Real>(0), after - before, rooms.fresh_radius(s)));
        }
        return part;
    };
    Real best = -1;
    const auto try_map = [&](const ShapeMap<Real>& map) {
        const Real part = part_with(map);
        if (part > best) {
            best = part;
            next_[object] = map;
        }
        return part == Real(1);
    };
    if (is_shortened_[object] != 0 && try_map(next_[object])) return best;
    const ShapeMap<Real> carried = rooms.carried(object, ends);
    if (try_map(carried)) return best;
    const ShapeMap<Real> bent = rooms.bent(object, carried, ends);
    if (try_map(bent)) return best;
    if (bent.is_steep || anew > static_cast<Real>(kWorthALook) * best) lacks_room_[object] = 1;
    return best;
}

template <class Real>
bool OwnGuard<Real>::carry(std::uint32_t object, const OwnRooms<Real>& rooms,
                           std::span<const Vec4<Real>> positions, std::span<const Vec4<Real>> ends) {
    std::optional<ShapeMap<Real>> map = rooms.moved(object, positions, ends);
    if (!map || rooms.part_between(object, *map) < Real(1)) return false;
    next_[object] = std::move(*map);
    return true;
}

template <class Real>
void OwnGuard<Real>::shorten(std::uint32_t object, Real part, const OwnRooms<Real>& rooms) {
    next_[object] = rooms.between(object, next_[object], part);
    is_shortened_[object] = 1;
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
    next_[object] = list.own.map(object);
    next_[object].center += displacement;
}

template <class Real>
void OwnGuard<Real>::go(std::uint32_t object, const Vec3<Real>& more, ContactList<Real>& list) const {
    ShapeMap<Real> map = next_[object];
    map.center += more;
    list.own.follow(object, map);
}

template class OwnGuard<float>;
template class OwnGuard<double>;

}  // namespace gelatin::cpu
