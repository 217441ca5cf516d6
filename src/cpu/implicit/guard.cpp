#include "cpu/implicit/guard.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "core/disjoint_sets.h"
#include "cpu/collision/colliders.h"
#include "cpu/contact/nearest_pairs.h"
#include "cpu/contact/tuning.h"
#include "cpu/implicit/rigid_inertia.h"
#include "model/for_each_index.h"

namespace gelatin::cpu {
namespace {

// What has to be left of a gap, both less rounding [m].
template <class Real>
Real least_gap(const NearPair<Real>& near, Real gap) {
    return std::min(static_cast<Real>(tuning::kLeastOfReach) * static_cast<Real>(near.pair.reach),
                    std::max(static_cast<Real>(tuning::kLeastOfGap) * gap,
                             static_cast<Real>(tuning::kLeastOfRounding) * near.rounding));
}

}  // namespace

template <class Real>
Guard<Real>::Guard(std::shared_ptr<const Model> model, std::shared_ptr<const ContactSurface> surface)
    : model_(std::move(model)),
      surface_(std::move(surface)),
      rigid_bodies_(model_),
      frames_(model_->objects.size()),
      wanted_(model_->node_count()),
      first_(model_->node_count(), kNoNode),
      is_changed_(model_->node_count()),
      is_frozen_(model_->node_count()) {}

// Islands of objects with pairs in common. Where something is held, they go as that does, if it all goes the
// same way.
template <class Real>
void Guard<Real>::find_frames(const Paths<Real>& paths, std::span<const NearPair<Real>> pairs,
                              std::span<const Vec4<Real>> ends) {
    DisjointSets islands(model_->objects.size());
    for (const NearPair<Real>& near : pairs) islands.unite(near.pair.object, near.pair.other);
    struct Sums {
        double weight = 0.0, squares = 0.0;
        glm::dvec3 moved{0.0};
    };
    std::vector<Sums> free(frames_.size()), held = free;
    for (std::uint32_t o = 0; o < frames_.size(); ++o) {
        const Range& nodes = model_->objects[o].nodes;
        const std::uint32_t island = islands.least(o);
        for (std::uint32_t n = nodes.first; n < nodes.end(); ++n) {
            const bool is_held = ends[n].w == Real(0);
            const double weight = is_held ? 1.0 : static_cast<double>(model_->masses[n]);
            const glm::dvec3 d(Vec3<Real>(ends[n]) - Vec3<Real>(paths.from[n]));
            Sums& sums = (is_held ? held : free)[island];
            sums.weight += weight;
            sums.moved += weight * d;
            sums.squares += weight * glm::dot(d, d);
        }
    }
    for (std::uint32_t o = 0; o < frames_.size(); ++o) {
        const std::uint32_t island = islands.least(o);
        const Sums& sums = (held[island].weight > 0.0 ? held : free)[island];
        const glm::dvec3 mean = sums.weight > 0.0 ? sums.moved / sums.weight : glm::dvec3(0.0);
        const bool is_same =
            sums.squares <= (1.0 + tuning::kHardly * tuning::kHardly) * sums.weight * glm::dot(mean, mean);
        frames_[o] = held[island].weight == 0.0 || is_same ? Vec3<Real>(mean) : Vec3<Real>(0);
    }
    for (Vec3<Real>& frame : frames_) frame = outside_planes(frame);
}

// No island as a whole goes into a plane, nor by what keeps it out of one into another.
template <class Real>
Vec3<Real> Guard<Real>::outside_planes(Vec3<Real> frame) const {
    bool is_outside = true;
    for (const Collider& plane : model_->colliders)
        if (plane.kind == 0) {
            const Vec3<Real> normal(plane.center);
            frame -= std::min(glm::dot(normal, frame), Real(0)) * normal;
        }
    for (const Collider& plane : model_->colliders)
        is_outside = is_outside && (plane.kind != 0 || !(glm::dot(Vec3<Real>(plane.center), frame) <
                                                         Real(-1e-6) * glm::length(frame)));
    return is_outside ? frame : Vec3<Real>(0);
}

template <class Real>
void Guard<Real>::add(std::uint32_t node, const Vec3<Real>& normal, Real room) {
    half_spaces_.push_back({first_[node], normal, room});
    first_[node] = static_cast<std::uint32_t>(half_spaces_.size() - 1);
    is_changed_[node] = 1;
}

template <class Real>
void Guard<Real>::keep_outside_colliders(const Paths<Real>& paths, std::span<const Real> compliances,
                                         std::span<Vec4<Real>> ends) {
    for (const Collider& collider : model_->colliders) {
        for (std::uint32_t n = 0; n < model_->body_node_count(); ++n) {
            if (compliances[n] == Real(0)) continue;
            const Real distance = surface_distance(collider, Vec3<Real>(ends[n])).distance;
            if (distance >=
                static_cast<Real>(tuning::kLeastOfReach * surface_->thicknesses[model_->node_objects[n]]))
                continue;
            const auto [least, space] = beside_collider(collider, n, paths);
            if (distance >= least) continue;
            if (collider.kind == 0) {  // place() knows them all
                is_changed_[n] = 1;
                has_changed_ = true;
            } else {
                add(n, space.normal, space.room);
            }
        }
    }
}

template <class Real>
typename Guard<Real>::BesideCollider Guard<Real>::beside_collider(const Collider& collider,
                                                                  std::uint32_t node,
                                                                  const Paths<Real>& paths) const {
    const SurfaceDistance<Real> from = surface_distance(collider, Vec3<Real>(paths.from[node]));
    const auto thickness = static_cast<Real>(surface_->thicknesses[model_->node_objects[node]]);
    const Real least = std::min({static_cast<Real>(tuning::kLeastOfReach) * thickness,
                                 static_cast<Real>(tuning::kLeastOfGap) * from.distance, from.distance});
    const Real frame = glm::dot(from.normal, frames_[model_->node_objects[node]]);
    return {least, {kNoNode, -from.normal, (from.distance - least) + frame}};
}

template <class Real>
bool Guard<Real>::is_apart(const NearPair<Real>& near, const Paths<Real>& paths,
                           std::span<const Vec4<Real>> ends) const {
    const ContactPair& pair = near.pair;
    const Real gap = near.gap - near.rounding;
    if (!(gap > Real(0))) return false;
    const Real least = least_gap(near, gap) + near.rounding;
    if (separation<Real>(pair, near.normal, ends) >= least) return true;
    // Piece by piece: from each place on the way goes on as far as the direction there, or that at the end,
    // separates.
    ContactPair local = pair;
    local.nodes = {0, 1, 2, 3};
    std::array<Vec4<Real>, 4> here{}, next{};
    const auto go_to = [&](Real t, std::array<Vec4<Real>, 4>& places) {
        for (std::size_t k = 0; k < 4; ++k) {
            const Vec4<Real>&from = paths.from[pair.nodes[k]], &to = ends[pair.nodes[k]];
            places[k] = t == Real(1) ? to : from + t * (to - from);
        }
    };
    const auto measure = [&](const std::array<Vec4<Real>, 4>& places, Vec3<Real>& normal, Real& rounding) {
        MeasuredPairs<Real> measured;
        measure_pairs({&local, 1}, places, measured);
        if (!(measured.gaps[0] > Real(0))) return false;
        normal =
            Vec3<Real>(measured.apart[0][0], measured.apart[1][0], measured.apart[2][0]) / measured.gaps[0];
        rounding = std::max(rounding, measured.rounding[0]);
        return true;
    };
    const auto separates = [&](const Vec3<Real>& direction, Real wanted) {
        return separation<Real>(local, direction, here) >= wanted &&
               separation<Real>(local, direction, next) >= wanted;
    };
    Real t = 0, length = 1, rounding = near.rounding;
    Vec3<Real> normal = near.normal, ahead(0);
    go_to(Real(0), here);
    while (t < Real(1)) {
        const Real to = t + length;
        go_to(to, next);
        if (!measure(next, ahead, rounding)) return false;
        if (separates(normal, least + rounding) || separates(ahead, least + rounding)) {
            t = to;
            here = next;
            normal = ahead;
            continue;
        }
        if (to == Real(1) && separation<Real>(local, ahead, next) < least + rounding)
            return false;  // too near there
        length *= Real(0.5);
        if (length < static_cast<Real>(tuning::kShortestPiece)) return false;
    }
    return true;
}

template <class Real>
void Guard<Real>::clip(const NearPair<Real>& near, const Paths<Real>& paths,
                       std::span<const Real> compliances, std::span<const Vec4<Real>> ends) {
    const ContactPair& pair = near.pair;
    const Vec3<Real> origin(paths.from[pair.nodes[0]]), n = near.normal;
    Real heights[4], top = 0, bottom = std::numeric_limits<Real>::infinity(), first = 0, second = 0;
    Real approach = 0;  // of nodes that do not yield
    const Vec3<Real>& frame = frames_[pair.object];
    for (std::size_t k = 0; k < 4; ++k) {
        const std::uint32_t node = pair.nodes[k];
        heights[k] = glm::dot(n, Vec3<Real>(paths.from[node]) - origin);
        const Real w = near.weights[static_cast<int>(k)];
        const Real along = ends[node].w == Real(0)
                               ? glm::dot(n, Vec3<Real>(ends[node]) - Vec3<Real>(paths.from[node]) - frame)
                               : Real(0);
        if (pair.side_of(k) == 0) {
            top = std::max(top, heights[k]);
            first += w * w * compliances[node];
            approach = std::max(approach, along);
        } else {
            bottom = std::min(bottom, heights[k]);
            second += w * w * compliances[node];
            approach = std::max(approach, -along);
        }
    }
    const Real gap = (bottom - top) - near.rounding;
    const Real room = gap - least_gap(near, gap);
    const Real usable =
        (room > Real(0) ? static_cast<Real>((1.0 - tuning::kSlightly)) : Real(1)) * room - approach;
    Real share = Real(0.5);
    if (first + second > Real(0)) {
        share = first / (first + second);
        if (first > Real(0) && second > Real(0))
            share = std::clamp(share, static_cast<Real>(tuning::kSlightly),
                               Real(1) - static_cast<Real>(tuning::kSlightly));
    }
    for (std::size_t k = 0; k < 4; ++k) {
        const std::uint32_t node = pair.nodes[k];
        if (ends[node].w == Real(0)) continue;
        const bool is_first = pair.side_of(k) == 0;
        if (!(gap > Real(0))) {
            is_frozen_[node] = 1;
            is_changed_[node] = 1;
        } else if (is_first) {
            add(node, n, (top - heights[k]) + share * usable);
        } else {
            add(node, -n, (heights[k] - bottom) + (Real(1) - share) * usable);
        }
    }
    ++clipped_count_;
    has_changed_ = true;
}

// All planes, as what keeps a node out of one may push it into another.
template <class Real>
template <class Use>
void Guard<Real>::for_spaces(std::uint32_t node, const Paths<Real>& paths, const Use& use) const {
    for (std::uint32_t h = first_[node]; h != kNoNode; h = half_spaces_[h].next) use(half_spaces_[h]);
    for (std::size_t c = model_->colliders.size(); c-- > 0;)
        if (model_->colliders[c].kind == 0) use(beside_collider(model_->colliders[c], node, paths).space);
}

// As place() does with a node: a rigid body's motion is projected on the half spaces of all of its nodes, as
// impulses would change it, and then shortened.
template <class Real>
void Guard<Real>::place_body(std::uint32_t object, const Paths<Real>& paths, std::span<Vec4<Real>> ends) {
    const Range& nodes = model_->objects[object].nodes;
    const std::span<const Vec4<Real>> starts = std::span(paths.from).subspan(nodes.first, nodes.count);
    std::vector<Vec4<Real>> wanted(starts.begin(), starts.end());
    for (std::uint32_t k = 0; k < nodes.count; ++k) wanted[k] += Vec4<Real>(wanted_[nodes.first + k], 0);
    const Pose from = rigid_bodies_.nearest(object, starts), to = rigid_bodies_.nearest(object, wanted);
    glm::dvec3 s = to.center - from.center, w = rotation_vector(to.rotation * glm::transpose(from.rotation));
    RigidSums sums;
    bool is_frozen = false;
    for (std::uint32_t n = nodes.first; n < nodes.end(); ++n) {
        sums.add(glm::dvec3(paths.from[n]) - from.center, static_cast<double>(model_->masses[n]),
                 glm::dvec3(0.0));
        is_frozen = is_frozen || is_frozen_[n] != 0;
    }
    const RigidInertia inertia(sums);
    const auto arm = [&](std::uint32_t n) { return glm::dvec3(paths.from[n]) - from.center; };
    // visit(normal, displacement along it, room, arm at the end) where a node is out of its half space.
    const auto for_all = [&](double part, const auto& visit) {
        const glm::dmat3 turn = rotation_about(part * w);
        for (std::uint32_t n = nodes.first; n < nodes.end(); ++n) {
            if (surface_->places[n] == kNoNode) continue;
            const glm::dvec3 r = turn * arm(n), d = part * s + r - arm(n);
            for_spaces(n, paths, [&](const HalfSpace& space) {
                const glm::dvec3 normal(space.normal);
                const double along = glm::dot(normal, d), room = static_cast<double>(space.room);
                if (along - room > 1e-6 * glm::length(d)) visit(normal, along, room, r);
            });
        }
    };
    for (std::uint32_t k = 0; k < tuning::kMostRounds; ++k) {
        bool is_outside = false;
        glm::dvec3 force(0.0), moment(0.0);
        double most = 0.0;
        for_all(1.0, [&](const glm::dvec3& normal, double along, double room, const glm::dvec3& r) {
            const glm::dvec3 turning = glm::cross(r, normal);
            const double mobility =
                inertia.inverse_mass + glm::dot(turning, inertia.inverse_inertia * turning);
            if (along - room <= most) return;
            most = along - room;  // the farthest first
            force = most / mobility * normal;
            moment = most / mobility * turning;
            is_outside = true;
        });
        if (!is_outside) break;
        s -= inertia.inverse_mass * force;
        w -= inertia.inverse_inertia * moment;
    }
    double part = is_frozen ? 0.0 : 1.0;
    for (std::uint32_t k = 0; part > 0.0; ++k) {
        double shorter = 1.0;
        for_all(part, [&](const glm::dvec3&, double along, double room, const glm::dvec3&) {
            shorter = std::min(shorter, 0.99 * std::max(room, 0.0) / along);
        });
        if (shorter == 1.0) break;
        part *= k < tuning::kMostRounds ? shorter : 0.0;
    }
    const glm::dmat3 turn = rotation_about(part * w);
    for (std::uint32_t n = nodes.first; n < nodes.end(); ++n) {
        const glm::dvec3 end = from.center + part * s + turn * arm(n) + glm::dvec3(frames_[object]);
        ends[n] = Vec4<Real>(Vec3<Real>(end), ends[n].w);
        is_changed_[n] = 1;
    }
}

template <class Real>
void Guard<Real>::place(std::uint32_t node, const Paths<Real>& paths, std::span<Vec4<Real>> ends) {
    Vec3<Real> d = wanted_[node];
    const Real tiny = Real(1e-6) * glm::length(d);
    for (std::uint32_t k = 0; k < tuning::kMostRounds; ++k) {
        bool is_outside = false;
        for_spaces(node, paths, [&](const HalfSpace& space) {
            const Real over = glm::dot(space.normal, d) - space.room;
            if (!(over > tiny)) return;
            d -= over * space.normal;
            is_outside = true;
        });
        if (!is_outside) break;
    }
    Real part = 1;
    for_spaces(node, paths, [&](const HalfSpace& space) {
        const Real along = glm::dot(space.normal, d);
        if (along > space.room) part = std::min(part, std::max(space.room, Real(0)) / along);
    });
    if (is_frozen_[node] != 0) part = Real(0);
    const Vec3<Real> end = Vec3<Real>(paths.from[node]) + frames_[model_->node_objects[node]] + part * d;
    ends[node] = Vec4<Real>(end, ends[node].w);
}

template <class Real>
std::vector<std::uint32_t> Guard<Real>::run(const Paths<Real>& paths, std::span<const NearPair<Real>> pairs,
                                            std::span<const Real> compliances, std::span<Vec4<Real>> ends,
                                            std::vector<std::uint8_t>& is_blocked, std::size_t checked) {
    const std::vector<Vec4<Real>> wanted(ends.begin(), ends.end());
    is_blocked.resize(model_->objects.size());
    has_changed_ = false;
    for (bool any_blocked = true; any_blocked;) {
        std::copy(wanted.begin(), wanted.end(), ends.begin());
        for (std::size_t n = 0; n < ends.size(); ++n)
            if (is_blocked[model_->node_objects[n]] != 0 && ends[n].w == Real(0)) ends[n] = paths.from[n];
        move(paths, pairs, compliances, ends, checked);
        checked = 0;
        any_blocked = false;
        has_changed_ = has_changed_ || !half_spaces_.empty();
        for (std::size_t p = 0; p < pairs.size(); ++p) {
            if (is_clipped_[p] == 0 ||
                separation<Real>(pairs[p].pair, pairs[p].normal, ends) >= pairs[p].rounding)
                continue;
            for (const std::uint32_t n : pairs[p].pair.nodes) {
                std::uint8_t& blocked = is_blocked[model_->node_objects[n]];
                if (ends[n].w != Real(0) || blocked != 0) continue;
                blocked = 1;
                any_blocked = true;
            }
        }
    }
    std::vector<std::uint32_t> strays;
    for (const std::uint32_t n : model_->surface_parts.nodes) {
        const Real slack = paths.slack * static_cast<Real>(surface_->thicknesses[model_->node_objects[n]]);
        if (!(glm::distance(Vec3<Real>(ends[n]), Vec3<Real>(paths.to[n])) <= slack)) strays.push_back(n);
    }
    return strays;
}

template <class Real>
void Guard<Real>::move(const Paths<Real>& paths, std::span<const NearPair<Real>> pairs,
                       std::span<const Real> compliances, std::span<Vec4<Real>> ends, std::size_t checked) {
    half_spaces_.clear();
    std::fill(first_.begin(), first_.end(), kNoNode);
    for (auto* flags : {&is_changed_, &is_frozen_}) std::fill(flags->begin(), flags->end(), std::uint8_t(0));
    is_clipped_.assign(pairs.size(), 0);
    find_frames(paths, pairs, ends);
    for_each_index(ends.size(), [&](std::size_t n) {
        wanted_[n] = Vec3<Real>(ends[n]) - Vec3<Real>(paths.from[n]) - frames_[model_->node_objects[n]];
    });
    keep_outside_colliders(paths, compliances, ends);
    // In rounds: what is clipped moves nodes, so other pairs of these are checked again.
    std::vector<std::uint8_t> fails(pairs.size());
    for (bool is_first = true;; is_first = false) {
        bool any = false;
        for (std::uint32_t n = 0; n < ends.size(); ++n) {
            if (is_changed_[n] == 0) continue;
            if (!rigid_bodies_.is_rigid(model_->node_objects[n])) place(n, paths, ends);
            any = true;
        }
        for (const std::uint32_t o : rigid_bodies_.objects()) {
            const auto changed = is_changed_.begin() + model_->objects[o].nodes.first;
            if (std::find(changed, changed + model_->objects[o].nodes.count, 1) !=
                changed + model_->objects[o].nodes.count)
                place_body(o, paths, ends);
        }
        if (!is_first && !any) break;
        for_each_index(pairs.size(), [&](std::size_t p) {
            const NearPair<Real>& near = pairs[p];
            const bool is_due = (is_first && p >= checked) ||
                                std::any_of(near.pair.nodes.begin(), near.pair.nodes.end(),
                                            [&](std::uint32_t n) { return is_changed_[n] != 0; });
            fails[p] = is_due && !is_apart(near, paths, ends) ? 1 : 0;
        });
        std::fill(is_changed_.begin(), is_changed_.end(), std::uint8_t(0));
        for (std::size_t p = 0; p < pairs.size(); ++p) {
            if (fails[p] == 0) continue;
            if (is_clipped_[p] == 0) {
                clip(pairs[p], paths, compliances, ends);
                is_clipped_[p] = 1;
            } else if (separation<Real>(pairs[p].pair, pairs[p].normal, ends) < pairs[p].rounding) {
                // Rounding, or what is held: nodes of the pair stay where they are in the frame.
                for (const std::uint32_t n : pairs[p].pair.nodes)
                    if (is_frozen_[n] == 0 && ends[n].w != Real(0)) is_frozen_[n] = is_changed_[n] = 1;
            }
        }
    }
}

template class Guard<float>;
template class Guard<double>;

}  // namespace gelatin::cpu
