#include "cpu/implicit/contact_rows.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "cpu/collision/colliders.h"
#include "cpu/contact/feasible_region.h"
#include "cpu/contact/nearest_pairs.h"
#include "cpu/contact/tuning.h"

namespace gelatin::cpu {

template <class Real>
ContactRows<Real>::ContactRows(std::shared_ptr<const Model> model,
                               std::shared_ptr<const ContactSurface> surface)
    : model_(std::move(model)), surface_(std::move(surface)) {}

template <class Real>
void ContactRows<Real>::add(const Start& start, ContactRow<Real> row, Real weight, Real first, Real second,
                            std::vector<ContactRow<Real>>& rows) {
    const auto known = std::lower_bound(memory_.begin(), memory_.end(), row.key,
                                        [](const Memory& m, std::uint64_t key) { return m.key < key; });
    const bool is_known = known != memory_.end() && known->key == row.key;
    if (is_known)
        row.ease =
            known->ease * std::max(Real(0), Real(1) - start.step / static_cast<Real>(tuning::kImpactTime));
    if (!is_known && row.gap <= Real(0)) row.ease = static_cast<Real>(tuning::kHardly) * row.reach - row.gap;
    row.gap += row.ease;
    const Real there = row.gap_at(relative<Real>(row, start.expected));
    row.stiffness = weight * Real(4) / (first + second);
    const Real reach = row.reach;
    if (is_known) {
        row.hold = known->hold - glm::dot(known->hold, row.normal) * row.normal;
        row.limit = known->limit;
        row.reach = std::max(known->reach, std::min(reach, row.gap));
        Real& nearest = nearest_gaps_.try_emplace({row.object, row.other}, Real(1)).first->second;
        nearest = std::min(nearest, row.gap / row.reach);
        row.reach = std::min(reach, row.reach + reach * start.last_step / static_cast<Real>(tuning::kEasing));
    } else {
        new_rows_.push_back(static_cast<std::uint32_t>(rows.size()));
        const Real nearest =
            std::max(there, static_cast<Real>(tuning::kChordGap) * std::min(row.gap, row.reach));
        row.limit = row.friction * row.force_of(nearest);
    }
    // Of belts, whose surfaces move within themselves.
    const auto surface_velocity = [&](std::uint32_t collider) {
        return Vec3<Real>(model_->surfaces[collider - model_->body_count()].velocity);
    };
    Vec3<Real> slip(0);
    if (row.object != kNoNode && !model_->is_body(row.object)) slip -= surface_velocity(row.object);
    if (!model_->is_body(row.other)) slip += surface_velocity(row.other);
    row.hold += row.stiffness * start.step * (slip - glm::dot(slip, row.normal) * row.normal);
    rows.push_back(row);
}

template <class Real>
void ContactRows<Real>::make(const Start& start, std::span<const NearPair<Real>> pairs,
                             const AttachmentRows<Real>& attachments, std::vector<ContactRow<Real>>& rows) {
    rows.clear();
    new_rows_.clear();
    nearest_gaps_.clear();
    const FeasibleRegion<Real> region(*model_, *surface_, start.positions);
    for (const NearPair<Real>& near : pairs) {
        const ContactPair& pair = near.pair;
        if (!(near.gap > Real(0))) continue;
        const Attachment* tied = pair.is_own() ? nullptr : attachments.attachment_at(pair);
        if (tied != nullptr && tied->is_firm) continue;
        const Vec3<Real> apart = near.gap * near.normal;
        Real weight = region.weight(pair, apart, near.weights);
        if (!pair.is_edges() && !(std::min({near.weights.y, near.weights.z, near.weights.w}) > Real(0)))
            weight *=
                std::max(region.weight_of_node(pair.first, apart), region.weight_along_normal(pair, apart));
        if (!(weight > Real(0))) continue;
        ContactRow<Real> row;
        // By side: of weights, and of those of free nodes; and how much these yield.
        std::array<Real, 2> sums{}, free{}, yields{};
        for (std::size_t k = 0; k < 4; ++k) {
            const Real w = near.weights[static_cast<int>(k)], yield = start.compliances[pair.nodes[k]];
            if (w == Real(0)) continue;
            const std::size_t side = pair.side_of(k) == 0 ? 0 : 1;
            row.nodes[row.count] = pair.nodes[k];
            row.weights[row.count++] = side == 0 ? -w : w;
            sums[side] += w;
            if (yield > Real(0)) free[side] += w;
            yields[side] += w * w * yield;
        }
        // Where held nodes bear most of a side, it is no stiffer than its free ones: these cannot bring apart
        // what the others press together.
        for (const std::size_t side : {0, 1})
            if (free[side] > Real(0)) yields[side] /= free[side] * free[side];
        const auto [first, second] = yields;
        if (!(first + second > Real(0))) continue;
        // Of each side 1 in all: what contacts exert on both cancels but for rounding.
        for (std::uint32_t k = 0; k < row.count; ++k)
            row.weights[k] /= sums[row.weights[k] < Real(0) ? 0 : 1];
        const ContactSurface::Touch& touch = surface_->touch(pair.object, pair.other);
        row.object = pair.object;
        row.other = pair.other;
        row.normal = near.normal;
        row.gap = near.gap;
        row.reach = static_cast<Real>(pair.reach);
        // Parts of a body that are near each other at rest do not press there, nor bodies that are attached.
        const std::vector<glm::vec4>* at_rest = pair.is_own()     ? &model_->positions
                                                : tied != nullptr ? tied->positions.get()
                                                                  : nullptr;
        const Real rest_reach =
            at_rest == nullptr ? row.reach : static_cast<Real>(tuning::kOfRestGap) * gap_in(*at_rest, pair);
        if (rest_reach < row.reach) {
            row.reach = rest_reach;
            const Real there = row.gap_at(relative<Real>(row, start.expected));
            const bool is_idle = std::min(row.gap, there) > static_cast<Real>(tuning::kIdleGap) * row.reach;
            if (is_idle || !(row.reach > Real(0))) continue;  // 0: they overlapped
        }
        row.friction = static_cast<Real>(touch.friction);
        row.key = pair.is_edges() ? std::uint64_t(1) << 63 | std::uint64_t(pair.first) << 31 | pair.second
                                  : std::uint64_t(pair.first) << 31 | pair.other;
        add(start, row, weight * static_cast<Real>(touch.stiffness), first, second, rows);
    }
    for (std::uint32_t c = 0; c < model_->colliders.size(); ++c) {
        const Collider& collider = model_->colliders[c];
        for (std::uint32_t n = 0; n < model_->body_node_count(); ++n) {
            if (start.compliances[n] == Real(0) || attachments.is_tied_to_plane(n, c)) continue;
            const SurfaceDistance<Real> to = surface_distance(collider, Vec3<Real>(start.positions[n]));
            const auto reach = static_cast<Real>(surface_->thicknesses[model_->node_objects[n]]);
            const Real nearest = to.distance + std::min(Real(0), glm::dot(to.normal, start.expected[n]));
            if (nearest > static_cast<Real>(1.0 + tuning::kPathSlack) * reach) continue;  // as of pairs
            ContactRow<Real> row;
            row.nodes[0] = n;
            row.weights[0] = Real(1);
            row.count = 1;
            row.object = kNoNode;
            row.other = model_->node_objects[n];
            row.normal = to.normal;
            row.gap = to.distance;
            row.reach = reach;
            row.friction = static_cast<Real>(collider.friction);
            row.key = std::uint64_t(1) << 62 | std::uint64_t(c) << 31 | n;
            add(start, row, Real(1), Real(0), start.compliances[n], rows);
        }
    }
    // What is found nearer than all contacts that are known of two objects has not pressed so far: with all
    // of its reach it would bring in energy.
    for (const std::uint32_t r : new_rows_) {
        ContactRow<Real>& row = rows[r];
        const auto nearest = nearest_gaps_.find({row.object, row.other});
        const Real part = nearest == nearest_gaps_.end() ? Real(1) : nearest->second;
        // Alone it presses nothing: its reach is its gap, without rounding.
        row.reach = std::clamp(row.gap / part, static_cast<Real>(tuning::kHardly) * row.reach, row.reach);
    }
}

template <class Real>
Real ContactRows<Real>::gap_in(const std::vector<glm::vec4>& positions, const ContactPair& pair) const {
    MeasuredPairs<float> measured;
    measure_pairs({&pair, 1}, positions, measured);
    return static_cast<Real>(measured.gaps[0]);
}

template <class Real>
void ContactRows<Real>::note(std::span<const ContactRow<Real>> rows,
                             std::span<const Vec3<Real>> displacements,
                             std::span<const std::uint8_t> asleep) {
    noted_.clear();
    for (const Memory& memory : memory_)
        if (asleep[model_->is_body(memory.other) ? memory.other : memory.object] != 0)
            noted_.push_back(memory);
    for (const ContactRow<Real>& row : rows) {
        if (row.is_tie()) continue;
        const Vec3<Real> s = slip<Real>(row, displacements);
        ContactRow<Real> now = row;
        now.limit = row.friction * row.pressing(s);
        noted_.push_back({row.key, row.object, row.other, now.limit > Real(0) ? now.held(s) : Vec3<Real>(0),
                          now.limit, row.reach, row.ease});
    }
    std::stable_sort(noted_.begin(), noted_.end(),
                     [](const Memory& a, const Memory& b) { return a.key < b.key; });
}

template class ContactRows<float>;
template class ContactRows<double>;

}  // namespace gelatin::cpu
