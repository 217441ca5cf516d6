#include "cpu/contact/contact_aims.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>
#include <utility>

#include "cpu/contact/feasible_region.h"
#include "model/for_each_index.h"

namespace gelatin::cpu {
namespace {

// A contact's stiffness over that of the nodes in it. Stiffer ones rest sooner, up to about 4; with 20,
// stacks tremble.
constexpr double kStiffness = 4.0;
// Shorter steps do not make contacts stiffer: what they meet with less than a step's motion they would take
// up at once, and give nothing back [s].
constexpr double kStiffestStep = 1.0 / 60.0;
// Of the reach: what of a gap is left as it is.
constexpr double kLeastGap = 0.02;
// Of what is above that: how much both sides may use before the next aim.
constexpr double kUsable = 0.95;
// No side gets less or more of the gap than this and the rest, unless it is held.
constexpr double kLeastShare = 0.05;

constexpr std::size_t kPairsATask = 512;

template <class Real>
Vec3<Real> without_part_along(const Vec3<Real>& v, const Vec3<Real>& normal) {
    return v - glm::dot(v, normal) * normal;
}

}  // namespace

template <class Real>
ContactAims<Real>::ContactAims(std::shared_ptr<const Model> model,
                               std::shared_ptr<const ContactSurface> surface)
    : model_(std::move(model)),
      surface_(std::move(surface)),
      softness_(model_->node_count()),
      nodes_(model_, surface_) {}

template <class Real>
void ContactAims<Real>::begin(Real step, std::span<const Vec4<Real>> targets,
                              std::span<const Vec4<Real>> starts) {
    starts_ = starts;
    const std::vector<std::uint32_t>& nodes = model_->surface_parts.nodes;
    for_each_index(nodes.size(), [&](std::size_t s) {
        const std::uint32_t n = nodes[s];
        const Real inertia = targets[n].w;  // m / h^2 [N/m]
        const auto elasticity = static_cast<Real>(surface_->stiffness[n]);
        const auto stiffness = [&](Real seconds) {
            const Real ratio = step / seconds;
            return ratio * ratio * inertia + (Real(1) + starts[n].w / seconds) * elasticity;
        };
        softness_[n] = {};
        if (inertia > Real(0))
            softness_[n] = {Real(1) / stiffness(std::max(step, Real(kStiffestStep))),
                            inertia / stiffness(step)};
    });
}

template <class Real>
void ContactAims<Real>::run(const ContactList<Real>& list, std::span<const Vec4<Real>> positions,
                            AimFor use) {
    const std::size_t pairs = list.pairs.size(), edges = pairs - list.first_edges;
    aims_.resize(pairs);
    grips_.resize(pairs);
    nodes_.resize(list);
    const std::size_t node_tasks = (list.first_edges + kPairsATask - 1) / kPairsATask;
    found_.resize(node_tasks + (edges + kPairsATask - 1) / kPairsATask);
    for_each_index(0, found_.size(), 1, [&](std::size_t task) {
        found_[task].clear();
        const bool is_edges = task >= node_tasks;
        const std::size_t begin =
            is_edges ? list.first_edges + (task - node_tasks) * kPairsATask : task * kPairsATask;
        const std::size_t end = std::min(begin + kPairsATask, is_edges ? pairs : list.first_edges);
        aim_pairs(list, {static_cast<std::uint32_t>(begin), static_cast<std::uint32_t>(end - begin)},
                  positions, use, found_[task]);
    });
    presses_.clear();
    for (const std::vector<Press<Real>>& found : found_)
        presses_.insert(presses_.end(), found.begin(), found.end());
    if (use == AimFor::guess) {
        nodes_.stay(positions);
        return;
    }
    nodes_.share(list, presses_);
    nodes_.select(list, positions);
}

template <class Real>
void ContactAims<Real>::aim_pairs(const ContactList<Real>& list, const Range& pairs,
                                  std::span<const Vec4<Real>> positions, AimFor use,
                                  std::vector<Press<Real>>& presses) {
    const FeasibleRegion<Real> region(*model_, *surface_, positions);
    const auto aim = [&](std::size_t index, const MeasuredPairs<Real>& measured, std::size_t k) {
        const std::uint32_t p = pairs.first + static_cast<std::uint32_t>(index);
        const ContactPair& pair = list.pairs[p];
        const Vec3<Real> apart(measured.apart[0][k], measured.apart[1][k], measured.apart[2][k]);
        const Vec4<Real> weights{measured.weights[0][k], measured.weights[1][k], measured.weights[2][k],
                                 measured.weights[3][k]};
        const Real gap = measured.gaps[k], pair_reach = reach(pair);
        const Vec3<Real> normal = gap > Real(0) ? apart / gap : Vec3<Real>(0);
        const Division division = divide(pair, weights);
        aims_[p] = {normal, gap, division.yielding};
        if (use == AimFor::sweeps) divide_gap(pair, measured, k, normal, pair_reach, division.share);
        const ContactSurface::Touch& touch = surface_->touch(pair.object, pair.other);
        const Real stiffness =
            static_cast<Real>(touch.stiffness) * division.stiffness * region.weight(pair, apart, weights);
        if (!(stiffness > Real(0)) || !(pair_reach > Real(0))) return;
        const auto friction = static_cast<Real>(touch.friction);
        Press<Real> press{p,        normal,         gap,       weights,      pair_reach, stiffness,
                          friction, division.share, grips_[p], Vec3<Real>(0)};
        if (limit(gap, press) > Real(0)) {
            // What has slid before it pressed, friction did not resist.
            if (!press.grip.grips)
                grips_[p] = press.grip = {Vec3<Real>(0), slip(pair, press, positions), true};
            press.hold = hold(pair, press, positions);
        }
        presses.push_back(press);
    };
    for_measured<Real>(std::span(list.pairs).subspan(pairs.first, pairs.count), positions, aim);
}

// By how far the nodes yield to a force.
template <class Real>
typename ContactAims<Real>::Division ContactAims<Real>::divide(const ContactPair& pair,
                                                               const Vec4<Real>& weights) const {
    std::array<Real, 2> softness{};
    Real yielding = 0;
    std::array<bool, 2> is_free{};
    for (std::size_t k = 0; k < 4; ++k) {
        const Softness& own = softness_[pair.nodes[k]];
        const Real weight = weights[static_cast<int>(k)], soft = weight * weight * own.value;
        softness[pair.side_of(k)] += soft;
        yielding += soft * own.inertia;
        is_free[pair.side_of(k)] |= own.value > Real(0);
    }
    const Real sum = softness[0] + softness[1];
    Division division;
    division.stiffness = sum > Real(0) ? Real(kStiffness) / sum : Real(0);
    division.yielding = sum > Real(0) ? yielding / sum : Real(1);
    if (!is_free[0] || !is_free[1]) {
        division.share = is_free[0] ? Real(1) : Real(0);
    } else {
        division.share = sum > Real(0)
                             ? std::clamp(softness[0] / sum, Real(kLeastShare), Real(1 - kLeastShare))
                             : Real(0.5f);
    }
    return division;
}

// The gap is that between the sides' nodes along the normal, less what rounding could make of it, here and
// when nodes go to new positions.
template <class Real>
void ContactAims<Real>::divide_gap(const ContactPair& pair, const MeasuredPairs<Real>& measured,
                                   std::size_t column, const Vec3<Real>& normal, Real reach, Real share) {
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
    const Real usable = Real(kUsable) * std::max(gap - std::max(Real(kLeastGap) * reach, rounding), Real(0));
    for (std::size_t k = 0; k < 4; ++k) {
        const bool is_first = pair.side_of(k) == 0;
        const Real height = measured.heights[k][column];
        const Real head =
            is_first ? (top - height) + share * usable : (height - low) + (Real(1) - share) * usable;
        nodes_.plane(pair.slots[k]) = {is_first ? normal : -normal, gap > Real(0) ? head : Real(-1)};
    }
}

// What holds is carried from step to step, so that what sticks does not creep.
template <class Real>
Vec3<Real> ContactAims<Real>::hold(const ContactPair& pair, const Press<Real>& press,
                                   std::span<const Vec4<Real>> positions) const {
    return without_part_along(
        press.grip.held + press.stiffness * (slip(pair, press, positions) - press.grip.from), press.normal);
}

template <class Real>
Vec3<Real> ContactAims<Real>::slip(const ContactPair& pair, const Press<Real>& press,
                                   std::span<const Vec4<Real>> positions) const {
    Vec3<Real> slip(0);
    for (std::size_t k = 0; k < 4; ++k) {
        const std::uint32_t n = pair.nodes[k];
        const Vec3<Real> moved = Vec3<Real>(positions[n]) - Vec3<Real>(starts_[n]);
        slip += (pair.side_of(k) == 0 ? -press.weights[static_cast<int>(k)]
                                      : press.weights[static_cast<int>(k)]) *
                moved;
    }
    return without_part_along(slip, press.normal);
}

template <class Real>
Real ContactAims<Real>::gap(const ContactPair& pair, const Press<Real>& press,
                            std::span<const Vec4<Real>> positions) const {
    const Vec3<Real> origin(positions[pair.nodes[0]]);
    Real gap = 0;
    for (std::size_t k = 0; k < 4; ++k) {
        const Real weight = press.weights[static_cast<int>(k)];
        gap += (pair.side_of(k) == 0 ? -weight : weight) *
               glm::dot(press.normal, Vec3<Real>(positions[pair.nodes[k]]) - origin);
    }
    return gap;
}

template <class Real>
void ContactAims<Real>::carry_over(const std::vector<ContactPair>& old, const ContactList<Real>& list) {
    aims_.clear();
    presses_.clear();
    std::vector<Grip<Real>> grips(list.pairs.size());
    const auto rank = [&](const ContactPair& pair) { return pair.rank(surface_->places); };
    const auto is_before = [&](const ContactPair& a, const ContactPair& b) { return rank(a) < rank(b); };
    const std::span known(old.data(), grips_.size());
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, grips.size(), kPairsATask), [&](const auto& range) {
        auto next = std::lower_bound(known.begin(), known.end(), list.pairs[range.begin()], is_before);
        for (std::size_t p = range.begin(); p != range.end() && next != known.end(); ++p) {
            const auto wanted = rank(list.pairs[p]);
            while (next != known.end() && rank(*next) < wanted) ++next;
            if (next != known.end() && rank(*next) == wanted)
                grips[p] = grips_[static_cast<std::size_t>(next - known.begin())];
        }
    });
    grips_ = std::move(grips);
}

template <class Real>
void ContactAims<Real>::end(const ContactList<Real>& list, std::span<const Vec4<Real>> positions) {
    std::fill(grips_.begin(), grips_.end(), Grip<Real>{});
    energies_.resize(presses_.size());
    for_each_index(0, presses_.size(), 256, [&](std::size_t k) {
        const Press<Real>& press = presses_[k];
        const ContactPair& pair = list.pairs[press.pair];
        const Real gap_now = gap(pair, press, positions), most = limit(gap_now, press);
        energies_[k] = contact_energy(gap_now, press.reach, press.stiffness);
        if (!(most > Real(0))) return;
        Vec3<Real> held = hold(pair, press, positions);
        const Real length = glm::length(held);
        if (length > most) held *= most / length;
        energies_[k] += glm::dot(held, held) / (Real(2) * press.stiffness);
        grips_[press.pair] = {held, Vec3<Real>(0), true};
    });
}

template class ContactAims<float>;
template class ContactAims<double>;

}  // namespace gelatin::cpu
