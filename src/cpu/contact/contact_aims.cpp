#include "cpu/contact/contact_aims.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <tuple>
#include <utility>

#include "cpu/collision/nearest_points.h"
#include "cpu/contact/feasible_region.h"
#include "model/for_each_index.h"

namespace gelatin::cpu {
namespace {

// A contact's stiffness over that of the nodes in it. Stiffer ones rest sooner, up to about 4; with 20,
// stacks tremble.
constexpr double kStiffness = 4.0;
// Of the reach: what of a gap is left as it is.
constexpr double kLeastGap = 0.02;
// Of what is above that: how much both sides may use before the next aim.
constexpr double kUsable = 0.95;
// No side gets less or more of the gap than this and the rest, unless it is held.
constexpr double kLeastShare = 0.05;

template <class Real>
Vec3<Real> product(const SymmetricMatrix<Real>& m, const Vec3<Real>& v) {
    return {m.diagonal.x * v.x + m.beside.z * v.y + m.beside.y * v.z,
            m.beside.z * v.x + m.diagonal.y * v.y + m.beside.x * v.z,
            m.beside.y * v.x + m.beside.x * v.y + m.diagonal.z * v.z};
}

template <class Real>
Vec3<Real> without_part_along(const Vec3<Real>& v, const Vec3<Real>& normal) {
    return v - glm::dot(v, normal) * normal;
}

}  // namespace

template <class Real>
Real part_within(const Vec3<Real>& u, const Vec3<Real>& motion, Real radius) {
    const Vec3<Real> end = u + motion;
    if (glm::dot(end, end) <= radius * radius) return Real(1);
    const Real a = glm::dot(motion, motion), b = glm::dot(u, motion), c = glm::dot(u, u) - radius * radius;
    if (!(c < Real(0)) || !(a > Real(0))) return Real(0);
    const Real root = std::sqrt(b * b - a * c);
    const Real part = b > Real(0) ? -c / (b + root) : (root - b) / a;
    return std::clamp(Real(0.999f) * part, Real(0), Real(1));
}

template <class Real>
ContactAims<Real>::ContactAims(std::shared_ptr<const Model> model,
                               std::shared_ptr<const ContactSurface> surface, double friction)
    : model_(std::move(model)),
      surface_(std::move(surface)),
      object_of_(objects_of_nodes(*model_)),
      reach_(static_cast<Real>(surface_->reach)),
      friction_(static_cast<Real>(friction)),
      softness_(model_->node_count()),
      lightness_(model_->node_count()) {
    const std::size_t count = model_->surface_parts.nodes.size();
    first_slots_.resize(count);
    plane_counts_.resize(count);
    share_counts_.resize(count);
    is_stuck_.resize(count);
    aimed_at_.resize(count);
}

template <class Real>
void ContactAims<Real>::begin(Real step, std::span<const Vec4<Real>> targets,
                              std::span<const Vec4<Real>> starts) {
    starts_ = starts;
    for (const std::uint32_t n : model_->surface_parts.nodes) {
        const Real damped = Real(1) + starts[n].w / step;
        const Real stiffness = targets[n].w + damped * static_cast<Real>(surface_->stiffness[n]);
        softness_[n] = targets[n].w > Real(0) ? Real(1) / stiffness : Real(0);
        lightness_[n] = targets[n].w > Real(0) ? Real(1) / targets[n].w : Real(0);
    }
}

template <class Real>
void ContactAims<Real>::run(const ContactList<Real>& list, std::span<const Vec4<Real>> positions) {
    const std::size_t pairs = list.pairs.size();
    aims_.resize(pairs);
    grips_.resize(pairs);
    planes_.resize(list.slot_pairs.size());
    shares_.resize(list.slot_pairs.size());
    for_each_index(0, pairs, 256, [&](std::size_t p) {
        aims_[p].grip = grips_[p];
        aim(list.pairs[p], positions, aims_[p]);
        grips_[p] = aims_[p].grip;
    });
    const std::vector<std::uint32_t>& nodes = model_->surface_parts.nodes;
    for_each_index(nodes.size(), [&](std::size_t s) {
        const auto place = static_cast<std::uint32_t>(s);
        select(list, place, Vec3<Real>(positions[nodes[s]]));
    });
}

template <class Real>
void ContactAims<Real>::aim(const ContactPair& pair, std::span<const Vec4<Real>> positions,
                            PairAim<Real>& aim) {
    Vec3<Real> apart;
    find_nearest(pair, positions, aim, apart);
    share_stiffness(pair, aim);
    aim.stiffness *= FeasibleRegion<Real>(*model_, *surface_, positions).weight(pair, apart, aim.weights);
    divide_gap(pair, positions, aim);
    // What has slid before it pressed, friction did not resist.
    if (!aim.grip.grips && limit(aim.gap, aim) > Real(0))
        aim.grip = {Vec3<Real>(0), slip(pair, aim, positions), true};
    write_shares(pair, aim, positions);
}

template <class Real>
void ContactAims<Real>::find_nearest(const ContactPair& pair, std::span<const Vec4<Real>> positions,
                                     PairAim<Real>& aim, Vec3<Real>& apart) const {
    const auto at = [&](std::size_t k) { return Vec3<Real>(positions[pair.nodes[k]]); };
    if (pair.is_edges()) {
        const EdgeToEdge<Real> nearest =
            nearest_points<Real>(std::array{at(0), at(1)}, std::array{at(2), at(3)});
        const Real s = nearest.fraction, t = nearest.other_fraction;
        aim.weights = {1 - s, s, 1 - t, t};
        apart = nearest.apart;
    } else {
        const NodeToFace<Real> nearest = nearest_points<Real>(at(0), std::array{at(1), at(2), at(3)});
        aim.weights = {Real(1), nearest.weights};
        apart = nearest.apart;
    }
    aim.gap = glm::length(apart);
    aim.normal = aim.gap > Real(0) ? apart / aim.gap : Vec3<Real>(0);
}

// By how far the nodes yield to a force.
template <class Real>
void ContactAims<Real>::share_stiffness(const ContactPair& pair, PairAim<Real>& aim) const {
    std::array<Real, 2> softness{};
    Real lightness = 0;
    std::array<bool, 2> is_free{};
    for (std::size_t k = 0; k < 4; ++k) {
        const Real weight = aim.weights[static_cast<int>(k)], soft = softness_[pair.nodes[k]];
        softness[pair.side_of(k)] += weight * weight * soft;
        lightness += weight * weight * lightness_[pair.nodes[k]];
        is_free[pair.side_of(k)] |= soft > Real(0);
    }
    const Real sum = softness[0] + softness[1];
    aim.stiffness = sum > Real(0) ? Real(kStiffness) / sum : Real(0);
    aim.yielding = lightness > Real(0) ? sum / lightness : Real(1);
    if (!is_free[0] || !is_free[1]) {
        aim.share = is_free[0] ? Real(1) : Real(0);
    } else {
        aim.share = sum > Real(0) ? std::clamp(softness[0] / sum, Real(kLeastShare), Real(1 - kLeastShare))
                                  : Real(0.5f);
    }
}

// The gap is that between the sides' nodes along the normal, less what rounding could make of it, here and
// when nodes go to new positions.
template <class Real>
void ContactAims<Real>::divide_gap(const ContactPair& pair, std::span<const Vec4<Real>> positions,
                                   const PairAim<Real>& aim) {
    const Vec3<Real> origin(positions[pair.nodes[0]]);
    std::array<Real, 4> heights;
    Real top = -std::numeric_limits<Real>::infinity(), low = -top;
    Vec3<Real> extent(0), reach(0);
    for (std::size_t k = 0; k < 4; ++k) {
        const Vec3<Real> position(positions[pair.nodes[k]]), relative = position - origin;
        extent = glm::max(extent, glm::abs(relative));
        reach = glm::max(reach, glm::abs(position));
        heights[k] = glm::dot(aim.normal, relative);
        if (pair.side_of(k) == 0) {
            top = std::max(top, heights[k]);
        } else {
            low = std::min(low, heights[k]);
        }
    }
    const Real rounding =
        kEpsilon<Real> * glm::dot(glm::abs(aim.normal), Real(8) * extent + Real(4) * reach);
    const Real gap = (low - top) - rounding;
    const Real usable =
        Real(kUsable) * std::max(gap - std::max(Real(kLeastGap) * reach_, rounding), Real(0));
    for (std::size_t k = 0; k < 4; ++k) {
        const bool is_first = pair.side_of(k) == 0;
        const Real head = is_first ? (top - heights[k]) + aim.share * usable
                                   : (heights[k] - low) + (Real(1) - aim.share) * usable;
        planes_[pair.slots[k]] = {is_first ? aim.normal : -aim.normal, gap > Real(0) ? head : Real(-1)};
    }
}

// What holds is carried from step to step, so that what sticks does not creep.
template <class Real>
Vec3<Real> ContactAims<Real>::hold(const ContactPair& pair, const PairAim<Real>& aim,
                                   std::span<const Vec4<Real>> positions) const {
    return without_part_along(
        aim.grip.held + aim.stiffness * (slip(pair, aim, positions) - aim.grip.from), aim.normal);
}

template <class Real>
Vec3<Real> ContactAims<Real>::slip(const ContactPair& pair, const PairAim<Real>& aim,
                                   std::span<const Vec4<Real>> positions) const {
    Vec3<Real> slip(0);
    for (std::size_t k = 0; k < 4; ++k) {
        const std::uint32_t n = pair.nodes[k];
        const Vec3<Real> moved = Vec3<Real>(positions[n]) - Vec3<Real>(starts_[n]);
        slip += (pair.side_of(k) == 0 ? -aim.weights[static_cast<int>(k)] : aim.weights[static_cast<int>(k)]) *
                moved;
    }
    return without_part_along(slip, aim.normal);
}

template <class Real>
Real ContactAims<Real>::gap(const ContactPair& pair, const PairAim<Real>& aim,
                            std::span<const Vec4<Real>> positions) const {
    const Vec3<Real> origin(positions[pair.nodes[0]]);
    Real gap = 0;
    for (std::size_t k = 0; k < 4; ++k) {
        const Real weight = aim.weights[static_cast<int>(k)];
        gap += (pair.side_of(k) == 0 ? -weight : weight) *
               glm::dot(aim.normal, Vec3<Real>(positions[pair.nodes[k]]) - origin);
    }
    return gap;
}

template <class Real>
void ContactAims<Real>::write_shares(const ContactPair& pair, const PairAim<Real>& aim,
                                     std::span<const Vec4<Real>> positions) {
    const Real most = limit(aim.gap, aim);
    const Vec3<Real> holds = most > Real(0) ? hold(pair, aim, positions) : Vec3<Real>(0);
    for (std::size_t k = 0; k < 4; ++k) {
        const Real sign = pair.side_of(k) == 0 ? Real(1) : Real(-1);
        const Real share = pair.side_of(k) == 0 ? aim.share : Real(1) - aim.share;
        const Real weight = aim.weights[static_cast<int>(k)];
        const bool presses = share > Real(0) && weight > Real(0);
        shares_[pair.slots[k]] = {sign * aim.normal,
                                  aim.gap,
                                  presses ? Real(1) / share : Real(0),
                                  presses ? weight * aim.stiffness : Real(0),
                                  (-sign * weight) * holds,
                                  weight * most};
    }
}

// Keeps of a node's planes those that it can reach within its room, and of its shares those that press.
template <class Real>
void ContactAims<Real>::select(const ContactList<Real>& list, std::uint32_t place,
                               const Vec3<Real>& position) {
    const std::uint32_t first = list.row_starts[place], end = list.row_starts[place + 1];
    const std::uint32_t object = object_of_[model_->surface_parts.nodes[place]];
    const Vec3<Real> moved = position - list.found_at[place] - list.shifts[list.islands[object]];
    std::uint32_t planes = first, shares = first;
    std::uint8_t is_stuck = 0;
    for (std::uint32_t k = first; k < end; ++k) {
        const Plane plane = planes_[k];
        if (plane.head < Real(0)) is_stuck = 1;
        if (plane.head < list.rooms[place] - glm::dot(plane.towards, moved)) planes_[planes++] = plane;
        if (shares_[k].stiffness > Real(0)) shares_[shares++] = shares_[k];
    }
    first_slots_[place] = first;
    plane_counts_[place] = planes - first;
    share_counts_[place] = shares - first;
    is_stuck_[place] = is_stuck;
    aimed_at_[place] = position;
}

template <class Real>
void ContactAims<Real>::add(std::uint32_t node, const Vec3<Real>& position, NodeTerms<Real>& terms) const {
    const std::uint32_t place = surface_->places[node];
    const Vec3<Real> displacement = position - aimed_at_[place];
    const std::uint32_t first = first_slots_[place];
    for (std::uint32_t k = first; k < first + share_counts_[place]; ++k) {
        add_contact_share(shares_[k], reach_, displacement, terms);
        if (shares_[k].limit > Real(0)) add_friction_share(shares_[k], displacement, terms);
    }
}

template <class Real>
Vec3<Real> ContactAims<Real>::limited(const ContactList<Real>& list, std::uint32_t node,
                                      const Vec3<Real>& from, const Vec3<Real>& to,
                                      const NodeTerms<Real>& all) const {
    const std::uint32_t place = surface_->places[node];
    if (place == kNoNode) return to;
    if (is_stuck_[place] != 0) return from;
    const Vec3<Real> displacement = from - aimed_at_[place];
    Vec3<Real> motion = kept_to_planes(planes_of(list, place), displacement, to - from);
    const Vec3<Real> moved = from - list.found_at[place] - list.shifts[list.islands[object_of_[node]]];
    const Real part = part_within(moved, motion, list.rooms[place]);
    if (!(part == Real(1))) motion *= part;
    if (share_counts_[place] > 0) {
        const std::span<const ContactShare<Real>> shares(shares_.data() + first_slots_[place],
                                                         share_counts_[place]);
        motion *= least_along(shares, displacement, motion, all);
    }
    return from + motion;
}

// Along the planes in its way, the nearest two of which it is projected on; then it is shortened.
template <class Real>
Vec3<Real> ContactAims<Real>::kept_to_planes(std::span<const Plane> planes, const Vec3<Real>& displacement,
                                             Vec3<Real> motion) const {
    const auto beyond = [&](const Plane& plane) {
        const Real head = std::max(plane.head - glm::dot(plane.towards, displacement), Real(0));
        return glm::dot(plane.towards, motion) - head;
    };
    for (int pass = 0; pass < 2; ++pass) {
        Real farthest = 0;
        const Plane* worst = nullptr;
        for (const Plane& plane : planes) {
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
    for (const Plane& plane : planes) {
        const Real along = glm::dot(plane.towards, motion);
        const Real head = std::max(plane.head - glm::dot(plane.towards, displacement), Real(0));
        if (!(along <= head)) part = along > Real(0) ? std::min(part, head / along) : Real(0);
    }
    return part * motion;
}

// The part of a motion at which the node's objective is least, with contacts as they are and the rest to
// second order. A node just outside the reach feels nothing, and Newton's step would throw it onto a plane.
template <class Real>
Real ContactAims<Real>::least_along(std::span<const ContactShare<Real>> shares,
                                    const Vec3<Real>& displacement, const Vec3<Real>& motion,
                                    const NodeTerms<Real>& all) const {
    Real pull = glm::dot(all.force, motion), curvature = glm::dot(product(all.hessian, motion), motion);
    for (const ContactShare<Real>& share : shares) {  // what is left without contacts
        const Real along = glm::dot(share.towards, motion), gap = share.gap_at(displacement);
        pull += contact_force(gap, reach_, share.stiffness) * along;
        curvature -=
            share.inverse_share * contact_hessian(gap, reach_, share.stiffness) * along * along;
    }
    struct Slope {
        Real value, change;
    };
    const auto slope_at = [&](Real part) {
        Slope slope{part * curvature - pull, curvature};
        for (const ContactShare<Real>& share : shares) {
            const Real along = glm::dot(share.towards, motion);
            const Real gap = share.gap_at(displacement) - part * share.inverse_share * along;
            slope.value += contact_force(gap, reach_, share.stiffness) * along;
            slope.change +=
                share.inverse_share * contact_hessian(gap, reach_, share.stiffness) * along * along;
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
Real ContactAims<Real>::allowed_part(const ContactList<Real>& list, const Range& nodes,
                                     std::span<const Vec4<Real>> positions,
                                     std::span<const Vec3<Real>> displacements, Real part) const {
    for (std::uint32_t n = nodes.first; n < nodes.end(); ++n) {
        const std::uint32_t place = surface_->places[n];
        if (place == kNoNode) continue;
        if (is_stuck_[place] != 0) return Real(0);
        const Vec3<Real> position(positions[n]), before = position - aimed_at_[place];
        for (const Plane& plane : planes_of(list, place)) {
            const Real along = glm::dot(plane.towards, displacements[n]);
            const Real head = std::max(plane.head - glm::dot(plane.towards, before), Real(0));
            if (!(part * along <= head)) part = along > Real(0) ? head / along : Real(0);
        }
        const Vec3<Real> moved = position - list.found_at[place] - list.shifts[list.islands[object_of_[n]]];
        part *= part_within(moved, part * displacements[n], list.rooms[place]);
    }
    return part;
}

// Pairs are in the order of the surface nodes, then of the edges, and of what these are near, in both lists.
template <class Real>
void ContactAims<Real>::carry_over(const ContactList<Real>& old, const ContactList<Real>& list) {
    std::vector<Grip<Real>> grips(list.pairs.size());
    const auto rank = [&](const ContactPair& pair) {
        const std::uint32_t first = pair.is_edges() ? pair.first : surface_->places[pair.first];
        return std::tuple(pair.is_edges(), first, pair.second);
    };
    std::size_t before = 0;
    for (std::size_t p = 0; p < list.pairs.size() && before < grips_.size(); ++p) {
        const auto wanted = rank(list.pairs[p]);
        while (before < grips_.size() && rank(old.pairs[before]) < wanted) ++before;
        if (before < grips_.size() && rank(old.pairs[before]) == wanted) grips[p] = grips_[before];
    }
    grips_ = std::move(grips);
}

template <class Real>
void ContactAims<Real>::end(const ContactList<Real>& list, std::span<const Vec4<Real>> positions) {
    for_each_index(0, aims_.size(), 256, [&](std::size_t p) {
        const ContactPair& pair = list.pairs[p];
        const PairAim<Real>& aim = aims_[p];
        const Real most = limit(gap(pair, aim, positions), aim);
        grips_[p] = {};
        if (!(most > Real(0))) return;
        Vec3<Real> held = hold(pair, aim, positions);
        const Real length = glm::length(held);
        if (length > most) held *= most / length;
        grips_[p] = {held, Vec3<Real>(0), true};
    });
}

template float part_within(const Vec3<float>&, const Vec3<float>&, float);
template double part_within(const Vec3<double>&, const Vec3<double>&, double);
template class ContactAims<float>;
template class ContactAims<double>;

}  // namespace gelatin::cpu
