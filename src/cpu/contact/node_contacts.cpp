#include "cpu/contact/node_contacts.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include "cpu/contact/planes.h"
#include "model/for_each_index.h"

namespace gelatin::cpu {
namespace {

template <class Real>
Vec3<Real> product(const SymmetricMatrix<Real>& m, const Vec3<Real>& v) {
    return {m.diagonal.x * v.x + m.beside.z * v.y + m.beside.y * v.z,
            m.beside.z * v.x + m.diagonal.y * v.y + m.beside.x * v.z,
            m.beside.y * v.x + m.beside.x * v.y + m.diagonal.z * v.z};
}

}  // namespace

template <class Real>
NodeContacts<Real>::NodeContacts(std::shared_ptr<const Model> model,
                                 std::shared_ptr<const ContactSurface> surface)
    : model_(std::move(model)), surface_(std::move(surface)), object_of_(objects_of_nodes(*model_)) {
    const std::size_t count = model_->surface_parts.nodes.size();
    first_planes_.resize(count);
    plane_counts_.resize(count);
    share_starts_.resize(count + 1);
    is_stuck_.resize(count);
    presses_.resize(model_->node_count());
    free_.assign(model_->node_count(), Vec4<Real>(0, 0, 0, std::numeric_limits<Real>::infinity()));
}

template <class Real>
void NodeContacts<Real>::resize(const ContactList<Real>& list) {
    planes_.resize(list.slot_count());
}

// Each node's in the order of the pairs.
template <class Real>
void NodeContacts<Real>::share(const ContactList<Real>& list, const std::vector<Press<Real>>& presses) {
    const auto for_shares = [&](std::size_t index, const auto& use) {
        const Press<Real>& press = presses[index];
        const ContactPair& pair = list.pairs[press.pair];
        for (std::size_t k = 0; k < 4; ++k) {
            const Real part = pair.side_of(k) == 0 ? press.share : Real(1) - press.share;
            if (part > Real(0) && press.weights[static_cast<int>(k)] > Real(0)) use(pair, k, part);
        }
    };
    std::fill(share_starts_.begin(), share_starts_.end(), 0u);
    std::fill(presses_.begin(), presses_.end(), std::uint8_t(0));
    share_places_.resize(presses.size());
    for (std::size_t p = 0; p < presses.size(); ++p) {
        for_shares(p, [&](const ContactPair& pair, std::size_t k, Real) {
            share_places_[p][k] = share_starts_[surface_->places[pair.nodes[k]] + 1]++;
            presses_[pair.nodes[k]] = 1;
        });
    }
    std::partial_sum(share_starts_.begin(), share_starts_.end(), share_starts_.begin());
    shares_.resize(share_starts_.back());
    for_each_index(presses.size(), [&](std::size_t p) {
        const Press<Real>& press = presses[p];
        for_shares(p, [&](const ContactPair& pair, std::size_t k, Real part) {
            const Real sign = pair.side_of(k) == 0 ? Real(1) : Real(-1),
                       weight = press.weights[static_cast<int>(k)];
            shares_[share_starts_[surface_->places[pair.nodes[k]]] + share_places_[p][k]] = {
                sign * press.normal,
                press.gap,
                Real(1) / part,
                weight * press.stiffness,
                press.reach,
                (-sign * weight) * press.hold,
                press.friction,
                weight * press.friction * contact_force(press.gap, press.reach, press.stiffness)};
        });
    });
}

template <class Real>
void NodeContacts<Real>::select(const ContactList<Real>& list, std::span<const Vec4<Real>> positions) {
    const std::vector<std::uint32_t>& nodes = model_->surface_parts.nodes;
    for_each_index(nodes.size(), [&](std::size_t s) {
        select(list, static_cast<std::uint32_t>(s), Vec3<Real>(positions[nodes[s]]));
    });
}

template <class Real>
void NodeContacts<Real>::stay(std::span<const Vec4<Real>> positions) {
    const std::vector<std::uint32_t>& nodes = model_->surface_parts.nodes;
    for_each_index(nodes.size(), [&](std::size_t s) {
        free_[nodes[s]] = Vec4<Real>(Vec3<Real>(positions[nodes[s]]), Real(-1));
        is_stuck_[s] = 1;
    });
    std::fill(presses_.begin(), presses_.end(), std::uint8_t(0));
}

// Keeps of a node's planes those that it can reach within its room.
template <class Real>
void NodeContacts<Real>::select(const ContactList<Real>& list, std::uint32_t place,
                                const Vec3<Real>& position) {
    const std::uint32_t first = list.row_starts[place], end = list.row_starts[place + 1];
    const std::uint32_t node = model_->surface_parts.nodes[place];
    const Vec3<Real> moved = list.moved(place, object_of_[node], position);
    std::uint32_t planes = first;
    Real least = std::numeric_limits<Real>::infinity();  // of the planes
    for (std::uint32_t k = first; k < end; ++k) {
        const NodePlane<Real> plane = planes_[k];
        least = std::min(least, plane.head);
        const Real ahead = std::max(glm::dot(plane.towards, list.ways[place]), Real(0));
        if (plane.head < list.rooms[place] + ahead - glm::dot(plane.towards, moved))
            planes_[planes++] = plane;
    }
    first_planes_[place] = first;
    plane_counts_[place] = planes - first;
    is_stuck_[place] = least < Real(0) ? 1 : 0;
    least = std::min(
        {least, list.rooms[place] - list.beside_way(place, moved), list.own.free_around(place, position)});
    const Real free = presses_[node] != 0 || !(least > Real(0)) ? Real(-1) : Real(0.999f) * least * least;
    free_[node] = Vec4<Real>(position, free);
}

template <class Real>
void NodeContacts<Real>::add(std::uint32_t node, const Vec3<Real>& position, NodeTerms<Real>& terms) const {
    const std::uint32_t place = surface_->places[node];
    const Vec3<Real> displacement = position - aimed_at(node);
    for (const ContactShare<Real>& share : shares_of(place)) {
        const Real gap = share.gap_at(displacement);
        if (gap >= share.reach) continue;
        add_contact_share(share, displacement, terms);
        if (!(share.limit > Real(0))) continue;
        // Less where the node presses less than at the aim: few sweeps find far too much of that at first.
        ContactShare<Real> pressing = share;
        pressing.limit =
            std::min(share.limit, share.friction * contact_force(gap, share.reach, share.stiffness));
        if (pressing.limit > Real(0)) add_friction_share(pressing, displacement, terms);
    }
}

template <class Real>
Vec3<Real> NodeContacts<Real>::limited_nearby(const ContactList<Real>& list, std::uint32_t node,
                                              const Vec3<Real>& from, const Vec3<Real>& to,
                                              const NodeTerms<Real>& all) const {
    const std::uint32_t place = surface_->places[node];
    if (is_stuck_[place] != 0) return from;
    const Vec3<Real> displacement = from - aimed_at(node);
    Vec3<Real> motion = kept_to_planes(planes_of(place), displacement, to - from);
    const Vec3<Real> moved = list.moved(place, object_of_[node], from);
    const Real part = list.part_within_room(place, moved, motion);
    if (!(part == Real(1))) motion *= part;
    const Real own_part = list.own.part_within_room(place, from, motion);
    if (!(own_part == Real(1))) motion *= own_part;
    if (!model_->colliders.empty()) motion *= part_outside_planes<Real>(model_->colliders, from, motion);
    if (presses(node)) motion *= least_along(shares_of(place), displacement, motion, all);
    return from + motion;
}

// Along the planes in its way, the nearest two of which it is projected on; then it is shortened.
template <class Real>
Vec3<Real> NodeContacts<Real>::kept_to_planes(std::span<const NodePlane<Real>> planes,
                                              const Vec3<Real>& displacement, Vec3<Real> motion) const {
    const auto beyond = [&](const NodePlane<Real>& plane) {
        const Real head = std::max(plane.head - glm::dot(plane.towards, displacement), Real(0));
        return glm::dot(plane.towards, motion) - head;
    };
    for (int pass = 0; pass < 2; ++pass) {
        Real farthest = 0;
        const NodePlane<Real>* worst = nullptr;
        for (const NodePlane<Real>& plane : planes) {
            const Real distance = beyond(plane);
            if (distance > farthest) {
                farthest = distance;
                worst = &plane;
            }
        }
        if (worst == nullptr) return motion;
        motion -= farthest * worst->towards;
    }
    Real part = 1;
    for (const NodePlane<Real>& plane : planes) {
        const Real along = glm::dot(plane.towards, motion);
        const Real head = std::max(plane.head - glm::dot(plane.towards, displacement), Real(0));
        if (!(along <= head)) part = along > Real(0) ? std::min(part, head / along) : Real(0);
    }
    return part * motion;
}

// The part of a motion at which the node's objective is least, with contacts as they are and the rest to
// second order. A node just outside the reach feels nothing, and Newton's step would throw it onto a plane.
template <class Real>
Real NodeContacts<Real>::least_along(std::span<const ContactShare<Real>> shares,
                                     const Vec3<Real>& displacement, const Vec3<Real>& motion,
                                     const NodeTerms<Real>& all) const {
    Real pull = glm::dot(all.force, motion), curvature = glm::dot(product(all.hessian, motion), motion);
    for (const ContactShare<Real>& share : shares) {  // what is left without contacts
        const Real gap = share.gap_at(displacement);
        if (gap >= share.reach) continue;
        const Real along = glm::dot(share.towards, motion);
        pull += contact_force(gap, share.reach, share.stiffness) * along;
        curvature -= share.inverse_share * contact_hessian(gap, share.reach, share.stiffness) * along * along;
    }
    struct Slope {
        Real value, change;
    };
    const auto slope_at = [&](Real part) {
        Slope slope{part * curvature - pull, curvature};
        for (const ContactShare<Real>& share : shares) {
            const Real along = glm::dot(share.towards, motion);
            const Real gap = share.gap_at(displacement) - part * share.inverse_share * along;
            if (gap >= share.reach) continue;
            slope.value += contact_force(gap, share.reach, share.stiffness) * along;
            slope.change +=
                share.inverse_share * contact_hessian(gap, share.reach, share.stiffness) * along * along;
        }
        return slope;
    };
    Slope slope = slope_at(Real(1));
    if (!(slope.value > Real(0))) return Real(1);
    constexpr int kMostTries = 6;
    constexpr Real kNearEnough = Real(0.02f);
    Real low = 0, high = 1, part = Real(0.5f);
    for (int i = 0; i < kMostTries; ++i) {
        slope = slope_at(part);
        (slope.value > Real(0) ? high : low) = part;
        Real next = part - slope.value / slope.change;
        if (!(next > low && next < high)) next = Real(0.5f) * (low + high);
        const bool is_near = std::abs(next - part) < kNearEnough;
        part = next;
        if (is_near) break;
    }
    return part;
}

template <class Real>
Real NodeContacts<Real>::allowed_part(const ContactList<Real>& list, const Range& nodes,
                                      std::span<const Vec4<Real>> positions,
                                      std::span<const Vec3<Real>> displacements, Real part) const {
    for (std::uint32_t n = nodes.first; n < nodes.end(); ++n) {
        const std::uint32_t place = surface_->places[n];
        const Vec3<Real> position(positions[n]), before = position - aimed_at(n);
        if (place == kNoNode || is_free_at(n, position + part * displacements[n])) continue;
        if (is_stuck_[place] != 0) return Real(0);
        for (const NodePlane<Real>& plane : planes_of(place)) {
            const Real along = glm::dot(plane.towards, displacements[n]);
            const Real head = std::max(plane.head - glm::dot(plane.towards, before), Real(0));
            if (!(part * along <= head)) part = along > Real(0) ? head / along : Real(0);
        }
        const Vec3<Real> moved = list.moved(place, object_of_[n], position);
        part *= list.part_within_room(place, moved, part * displacements[n]);
        part *= list.own.part_within_room(place, position, part * displacements[n]);
    }
    return part;
}

template <class Real>
void NodeContacts<Real>::write(const ContactList<Real>& list, ContactLimits& limits) const {
    const std::vector<std::uint32_t>& nodes = model_->surface_parts.nodes;
    limits.nodes.resize(nodes.size());
    for_each_index(nodes.size(), [&](std::size_t s) {
        const auto place = static_cast<std::uint32_t>(s);
        const std::uint32_t node = nodes[s];
        const Vec3<Real> room_start = list.found_at[s] + list.shifts[list.islands[object_of_[node]]];
        limits.nodes[s] = {glm::vec4(free_[node]),
                           glm::vec4(room_start, list.rooms[s]),
                           glm::vec4(list.ways[s], is_stuck_[s] != 0 ? 0.0f : 1.0f),
                           glm::vec4(list.own.room(place)),
                           first_planes_[s],
                           plane_counts_[s],
                           share_starts_[s],
                           share_starts_[s + 1] - share_starts_[s]};
    });
    limits.planes.resize(planes_.size());
    for_each_index(planes_.size(),
                   [&](std::size_t k) { limits.planes[k] = glm::vec4(planes_[k].towards, planes_[k].head); });
    limits.shares.resize(shares_.size());
    for_each_index(shares_.size(), [&](std::size_t k) {
        const ContactShare<Real>& share = shares_[k];
        limits.shares[k] = {glm::vec4(share.towards, share.gap),
                            glm::vec4(share.inverse_share, share.stiffness, share.reach, share.friction),
                            glm::vec4(share.hold, share.limit)};
    });
}

template class NodeContacts<float>;
template class NodeContacts<double>;

}  // namespace gelatin::cpu
