#include "cpu/contact/contact_aims.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <tuple>
#include <utility>

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
Vec3<Real> without_part_along(const Vec3<Real>& v, const Vec3<Real>& normal) {
    return v - glm::dot(v, normal) * normal;
}

}  // namespace

template <class Real>
ContactAims<Real>::ContactAims(std::shared_ptr<const Model> model,
                               std::shared_ptr<const ContactSurface> surface, double friction)
    : model_(std::move(model)),
      surface_(std::move(surface)),
      friction_(static_cast<Real>(friction)),
      softness_(model_->node_count()),
      lightness_(model_->node_count()),
      nodes_(model_, surface_, friction) {}

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
    nodes_.resize(list);
    const auto aim_range = [&](std::size_t first, std::size_t end) {
        const std::size_t blocks = (end - first + kPairBlock - 1) / kPairBlock;
        for_each_index(0, blocks, 32, [&](std::size_t b) {
            const std::size_t begin = first + b * kPairBlock;
            aim_block(list,
                      {static_cast<std::uint32_t>(begin),
                       static_cast<std::uint32_t>(std::min(kPairBlock, end - begin))},
                      positions);
        });
    };
    aim_range(0, list.first_edges);
    aim_range(list.first_edges, pairs);
    nodes_.select(list, positions);
}

template <class Real>
void ContactAims<Real>::aim_block(const ContactList<Real>& list, const Range& pairs,
                                  std::span<const Vec4<Real>> positions) {
    MeasuredPairs<Real> measured;
    measure_pairs(std::span(list.pairs).subspan(pairs.first, pairs.count), positions, measured);
    const FeasibleRegion<Real> region(*model_, *surface_, positions);
    for (std::size_t k = 0; k < pairs.count; ++k) {
        const ContactPair& pair = list.pairs[pairs.first + k];
        PairAim<Real>& aim = aims_[pairs.first + k];
        const Vec3<Real> apart(measured.apart[0][k], measured.apart[1][k], measured.apart[2][k]);
        aim.weights = {measured.weights[0][k], measured.weights[1][k], measured.weights[2][k],
                       measured.weights[3][k]};
        aim.reach = static_cast<Real>(surface_->reach(pair.object, pair.other));
        aim.gap = measured.gaps[k];
        aim.normal = aim.gap > Real(0) ? apart / aim.gap : Vec3<Real>(0);
        aim.grip = grips_[pairs.first + k];
        share_stiffness(pair, aim);
        aim.stiffness *= region.weight(pair, apart, aim.weights);
        divide_gap(pair, measured, k, aim);
        // What has slid before it pressed, friction did not resist.
        if (!aim.grip.grips && limit(aim.gap, aim) > Real(0))
            grips_[pairs.first + k] = aim.grip = {Vec3<Real>(0), slip(pair, aim, positions), true};
        write_shares(pair, aim, positions);
    }
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
void ContactAims<Real>::divide_gap(const ContactPair& pair, const MeasuredPairs<Real>& measured,
                                   std::size_t column, const PairAim<Real>& aim) {
    Real top = -std::numeric_limits<Real>::infinity(), low = -top;
    for (std::size_t k = 0; k < 4; ++k) {
        const Real height = measured.heights[k][column];
        if (pair.side_of(k) == 0) {
            top = std::max(top, height);
        } else {
            low = std::min(low, height);
        }
    }
    const Real rounding = measured.rounding[column];
    const Real gap = (low - top) - rounding;
    const Real usable =
        Real(kUsable) * std::max(gap - std::max(Real(kLeastGap) * aim.reach, rounding), Real(0));
    for (std::size_t k = 0; k < 4; ++k) {
        const bool is_first = pair.side_of(k) == 0;
        const Real height = measured.heights[k][column];
        const Real head =
            is_first ? (top - height) + aim.share * usable : (height - low) + (Real(1) - aim.share) * usable;
        nodes_.plane(pair.slots[k]) = {is_first ? aim.normal : -aim.normal, gap > Real(0) ? head : Real(-1)};
    }
}

// What holds is carried from step to step, so that what sticks does not creep.
template <class Real>
Vec3<Real> ContactAims<Real>::hold(const ContactPair& pair, const PairAim<Real>& aim,
                                   std::span<const Vec4<Real>> positions) const {
    return without_part_along(aim.grip.held + aim.stiffness * (slip(pair, aim, positions) - aim.grip.from),
                              aim.normal);
}

template <class Real>
Vec3<Real> ContactAims<Real>::slip(const ContactPair& pair, const PairAim<Real>& aim,
                                   std::span<const Vec4<Real>> positions) const {
    Vec3<Real> slip(0);
    for (std::size_t k = 0; k < 4; ++k) {
        const std::uint32_t n = pair.nodes[k];
        const Vec3<Real> moved = Vec3<Real>(positions[n]) - Vec3<Real>(starts_[n]);
        slip +=
            (pair.side_of(k) == 0 ? -aim.weights[static_cast<int>(k)] : aim.weights[static_cast<int>(k)]) *
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
        nodes_.share(pair.slots[k]) = {sign * aim.normal,
                                       aim.gap,
                                       presses ? Real(1) / share : Real(0),
                                       presses ? weight * aim.stiffness : Real(0),
                                       aim.reach,
                                       (-sign * weight) * holds,
                                       weight * most};
    }
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

template class ContactAims<float>;
template class ContactAims<double>;

}  // namespace gelatin::cpu
