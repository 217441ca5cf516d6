#include "cpu/contact/guarded_move.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <limits>
#include <utility>

#include "cpu/collision/nearest_points.h"
#include "cpu/contact/island_motions.h"
#include "cpu/contact/planes.h"
#include "model/for_each_index.h"
#include "model/lumped_masses.h"

namespace gelatin::cpu {
namespace {

// Rounds in which movers that block each other are shortened: of a row that is stopped, one mover in each.
// After them, those still in the way make nothing of their own, and what comes behind them neither. After so
// many more whole islands stop.
constexpr int kMostRounds = 64, kMostStops = 100;
// What others are in the way of, but makes so much of its way, may make more after another detection if much
// is left: what slides, over the next edges.
constexpr double kProgress = 0.1;
// Rounds in which bodies that would meet themselves are shortened. After them, they make nothing.
constexpr int kMostOwnRounds = 4;
constexpr std::size_t kMovedPairsATask = 1024;

}  // namespace

template <class Real>
GuardedMove<Real>::GuardedMove(std::shared_ptr<const Model> model, std::vector<std::uint32_t> places)
    : model_(std::move(model)),
      places_(std::move(places)),
      object_of_(objects_of_nodes(*model_)),
      masses_(lumped_masses(*model_)),
      is_held_(model_->objects.size()),
      means_(model_->body_count()),
      ways_(model_->node_count()),
      longest_ways_(model_->objects.size()),
      ways_of_objects_(model_->objects.size()),
      parts_(model_->objects.size()),
      own_(model_),
      planned_(model_->node_count()) {
    std::vector<Range> ranges;
    for (const ModelObject& object : model_->objects) ranges.push_back(object.nodes);
    pieces_ = ObjectPieces(ranges);
}

template <class Real>
void GuardedMove<Real>::begin(std::span<const Vec4<Real>> positions) {
    for_each_index(0, is_held_.size(), 1, [&](std::size_t o) {
        const Range& nodes = model_->objects[o].nodes;
        const auto own = positions.subspan(nodes.first, nodes.count);
        is_held_[o] = std::any_of(own.begin(), own.end(), [](const auto& p) { return p.w == Real(0); });
    });
}

template <class Real>
bool GuardedMove<Real>::plan(const ContactList<Real>& list, const ContactAims<Real>& aims,
                             std::span<const Vec4<Real>> positions, std::span<Vec4<Real>> ends,
                             Closeness closeness, Movers movers, std::span<const std::uint8_t> is_rigid,
                             bool is_final) {
    movers_ = movers;
    own_.begin();
    if (movers == Movers::nodes) {
        tbb::parallel_for(std::size_t(0), model_->body_count(), [&](std::size_t o) {
            if (list.own.meets_itself(o))
                own_.bring_into_rooms(static_cast<std::uint32_t>(o), list.own, positions, ends);
        });
    }
    common_.assign(list.shifts.size(), Vec3<Real>(0));
    if (movers == Movers::objects) find_common_motions(list, positions, ends);
    const bool may_shift = limit_common_motions(list);
    keep_to_rooms(list, aims, positions, ends);
    room_parts_ = parts_;
    if (!is_final && lacks_room()) return false;
    find_courses(list, aims, positions, ends, closeness);
    keep_pairs_apart(list);
    keep_from_themselves(list, aims, positions, ends, closeness, is_rigid);
    if (movers == Movers::nodes) return true;
    const auto goes_on = [&](std::size_t o) {
        if (parts_[o] == Real(1)) return false;
        if (parts_[o] == room_parts_[o] || own_.lacks_room(o)) return true;
        const Real left = (Real(1) - parts_[o]) * ways_of_objects_[o];
        return parts_[o] > Real(kProgress) && left > aims.thickness(o);
    };
    for (std::size_t o = 0; o < parts_.size(); ++o)
        if (goes_on(o)) return false;
    return may_shift;
}

template <class Real>
bool GuardedMove<Real>::reaches(const ContactList<Real>& list, const ContactAims<Real>& aims,
                                std::span<const Vec4<Real>> positions, std::span<const Vec4<Real>> ends) {
    movers_ = Movers::objects;
    own_.begin();
    common_.assign(list.shifts.size(), Vec3<Real>(0));
    find_common_motions(list, positions, ends);
    limit_common_motions(list);
    keep_to_rooms(list, aims, positions, ends);
    room_parts_ = parts_;
    std::atomic<bool> reaches = !lacks_room();
    tbb::parallel_for(std::size_t(0), model_->body_count(), [&](std::size_t o) {
        if (list.own.meets_itself(o) &&
            !own_.reaches(static_cast<std::uint32_t>(o), list.own, positions, ends))
            reaches = false;
    });
    return reaches;
}

template <class Real>
const std::vector<Vec3<Real>>& GuardedMove<Real>::mean_motions(std::span<const Vec4<Real>> positions,
                                                               std::span<const Vec4<Real>> ends) {
    tbb::parallel_for(std::size_t(0), model_->body_count(), [&](std::size_t o) {
        const Range& nodes = model_->objects[o].nodes;
        glm::dvec3 sum(0.0);
        for (std::uint32_t n = nodes.first; n < nodes.end(); ++n)
            sum += static_cast<double>(model_->masses[n]) *
                   glm::dvec3(Vec3<Real>(ends[n]) - Vec3<Real>(positions[n]));
        means_[o] = Vec3<Real>(sum / masses_[o]);
    });
    return means_;
}

template <class Real>
void GuardedMove<Real>::find_common_motions(const ContactList<Real>& list,
                                            std::span<const Vec4<Real>> positions,
                                            std::span<const Vec4<Real>> ends) {
    const std::vector<Vec3<Real>> means =
        island_motions<Real>(*model_, list, mean_motions(positions, ends), is_held_);
    for (std::size_t i = 0; i < means.size(); ++i)
        if (list.is_fixed[i] == 0) common_[i] = means[i];
    keep_outside_planes(*model_, list, positions, common_);
}

// Bodies of an island go on with the gaps that they have; those to colliders change.
template <class Real>
void GuardedMove<Real>::drift(ContactList<Real>& list, const ContactAims<Real>& aims,
                              std::span<const Vec4<Real>> ends, std::span<Vec4<Real>> positions) {
    const auto has_none = [](const Vec3<Real>& drift) { return drift == Vec3<Real>(0); };
    if (std::all_of(list.drifts.begin(), list.drifts.end(), has_none)) return;
    const std::vector<Vec3<Real>> means =
        island_motions<Real>(*model_, list, mean_motions(positions, ends), is_held_);
    std::vector<Real> parts(means.size());  // of their drifts
    bool any = false;
    for (std::size_t i = 0; i < parts.size(); ++i) {
        const Real squared = glm::dot(list.drifts[i], list.drifts[i]);
        if (!(squared > Real(0))) continue;
        parts[i] =
            std::clamp(glm::dot(means[i], list.drifts[i]) / squared, Real(0), Real(1) - list.drifted[i]);
        any |= parts[i] > Real(0);
    }
    if (!any) return;
    movers_ = Movers::objects;
    std::vector<Real> allowed = parts;
    for (std::size_t p = 0; p < list.pairs.size(); ++p) {
        const ContactPair& pair = list.pairs[p];
        if (model_->is_body(pair.object) && model_->is_body(pair.other)) continue;
        const std::uint32_t island = list.island_of(pair);
        if (!(allowed[island] > Real(0))) continue;
        const std::size_t body_side = model_->is_body(pair.object) ? 0 : 1;
        std::array<Vec3<Real>, 4> nodes, motions;
        for (std::size_t k = 0; k < 4; ++k) {
            nodes[k] = Vec3<Real>(positions[pair.nodes[k]]);
            motions[k] = pair.side_of(k) == body_side ? allowed[island] * list.drifts[island] : Vec3<Real>(0);
        }
        const PairCourse<Real> course =
            best_course(pair, aims.aims()[p], aims.reach(pair), nodes, motions, Closeness::guess);
        if (course.is_free()) continue;
        allowed[island] *= part_left(course.gap_at(Real(0)), course.gap_at(Real(1)), course.least);
    }
    tbb::parallel_for(std::size_t(0), model_->body_count(), [&](std::size_t o) {
        const std::uint32_t island = list.islands[o];
        if (!(allowed[island] > Real(0))) return;
        const Vec4<Real> motion(allowed[island] * list.drifts[island], Real(0));
        const Range& nodes = model_->objects[o].nodes;
        for (std::uint32_t n = nodes.first; n < nodes.end(); ++n) positions[n] += motion;
        if (list.own.meets_itself(o)) list.own.shift(static_cast<std::uint32_t>(o), Vec3<Real>(motion));
    });
    for (std::size_t i = 0; i < parts.size(); ++i) {
        list.shifts[i] += allowed[i] * list.drifts[i];
        list.drifted[i] += allowed[i];
    }
}

// An island that has come too far has nothing in common until the next detection.
template <class Real>
bool GuardedMove<Real>::limit_common_motions(const ContactList<Real>& list) {
    bool may_shift = true;
    for (std::size_t i = 0; i < common_.size(); ++i) {
        if (part_within(list.shifts[i], common_[i], list.most_shift) == Real(1)) continue;
        common_[i] = Vec3<Real>(0);
        may_shift = false;
    }
    return may_shift;
}

template <class Real>
void GuardedMove<Real>::keep_to_rooms(const ContactList<Real>& list, const ContactAims<Real>& aims,
                                      std::span<const Vec4<Real>> positions,
                                      std::span<const Vec4<Real>> ends) {
    const bool are_nodes = movers_ == Movers::nodes;
    parts_.assign(are_nodes ? positions.size() : model_->objects.size(), Real(1));
    std::vector<Reach> reaches(model_->objects.size());
    const auto reach_of = [&](const ObjectPieces::Piece& piece) {
        Reach reach;
        const Vec3<Real> common = common_[list.islands[piece.object]];
        for (std::uint32_t n = piece.range.first; n < piece.range.end(); ++n) {
            // The nodes of a handle keep their shape: they go on with whole objects alone.
            if (are_nodes && positions[n].w == Real(0)) parts_[n] = Real(0);
            const std::uint32_t place = places_[n];
            if (place == kNoNode) continue;
            const Vec3<Real> position(positions[n]), motion = Vec3<Real>(ends[n]) - position - common;
            const Real part = list.part_within_room(place, list.moved(place, piece.object, position), motion);
            if (are_nodes) parts_[n] = std::min(parts_[n], part);
            const Real way = glm::length(motion);
            ways_[n] = glm::length(position - aims.nodes().aimed_at(n)) + way;
            reach.join({part, way, ways_[n]});
        }
        return reach;
    };
    pieces_.gather<Reach>(reaches, reach_of, [](Reach& reach, const Reach& more) { reach.join(more); });
    for (std::size_t o = 0; o < reaches.size(); ++o) {
        if (!are_nodes) parts_[o] = reaches[o].part;
        ways_of_objects_[o] = reaches[o].way;
        longest_ways_[o] = reaches[o].longest_way;
    }
}

template <class Real>
void GuardedMove<Real>::find_courses(const ContactList<Real>& list, const ContactAims<Real>& aims,
                                     std::span<const Vec4<Real>> positions, std::span<const Vec4<Real>> ends,
                                     Closeness closeness) {
    courses_.resize((list.pairs.size() + kMovedPairsATask - 1) / kMovedPairsATask);
    for_each_index(0, courses_.size(), 1, [&](std::size_t task) {
        courses_[task].clear();
        const std::size_t end = std::min((task + 1) * kMovedPairsATask, list.pairs.size());
        for (std::size_t p = task * kMovedPairsATask; p < end; ++p) {
            const ContactPair& pair = list.pairs[p];
            // The nodes of a body make the same part, of a motion that may turn (keep_from_themselves).
            if (pair.is_own() && movers_ == Movers::objects) continue;
            if (are_far_apart(pair, aims, aims.aims()[p], closeness)) continue;
            const Vec3<Real> common = common_[list.island_of(pair)];
            std::array<Vec3<Real>, 4> nodes, motions;
            for (std::size_t c = 0; c < 4; ++c) {
                nodes[c] = Vec3<Real>(positions[pair.nodes[c]]);
                motions[c] = Vec3<Real>(ends[pair.nodes[c]]) - nodes[c] - common;
            }
            PairCourse<Real> course =
                best_course(pair, aims.aims()[p], aims.reach(pair), nodes, motions, closeness);
            if (course.stays_free([](std::size_t) { return Real(1); })) continue;
            for (std::size_t c = 0; c < 4; ++c)
                course.movers[c] = movers_ == Movers::nodes ? pair.nodes[c]
                                   : pair.side_of(c) == 0   ? pair.object
                                                            : pair.other;
            courses_[task].push_back(course);
        }
    });
}

// Most pairs are too far apart for the ways of their nodes.
template <class Real>
bool GuardedMove<Real>::are_far_apart(const ContactPair& pair, const ContactAims<Real>& aims,
                                      const PairAim<Real>& aim, Closeness closeness) const {
    const Real least = least_gap(aim, aims.reach(pair), aim.gap, closeness);
    if (aim.gap - longest_ways_[pair.object] - longest_ways_[pair.other] > least) return true;
    std::array<Real, 2> ways{};
    for (std::size_t k = 0; k < 4; ++k) {
        Real& way = ways[pair.side_of(k)];
        way = std::max(way, ways_[pair.nodes[k]]);
    }
    return aim.gap - ways[0] - ways[1] > least;
}

// In each round every pair that would come too near shortens the movers that approach. Pairs without movers
// of such pairs are as they were.
template <class Real>
void GuardedMove<Real>::keep_pairs_apart(const ContactList<Real>& list) {
    next_parts_ = parts_;
    is_concerned_.assign(parts_.size(), 1);
    blocked_.resize(courses_.size());
    for (int round = 0;; ++round) {
        for_each_index(0, courses_.size(), 1, [&](std::size_t task) { find_blocked(task); });
        if (!shorten_blocked(round < kMostRounds)) return;
        if (round >= kMostRounds + kMostStops && !stop_blocked_islands(list)) return;
    }
}

// Those that would come too near now, of pairs of movers that are concerned. What stays free whatever comes
// is forgotten.
template <class Real>
void GuardedMove<Real>::find_blocked(std::size_t task) {
    std::vector<PairCourse<Real>>& courses = courses_[task];
    std::vector<std::uint32_t>& blocked = blocked_[task];
    blocked.clear();
    std::uint32_t kept = 0;
    for (std::size_t k = 0; k < courses.size(); ++k) {
        const PairCourse<Real>& course = courses[k];
        const auto part = [&](std::size_t c) { return parts_[course.movers[c]]; };
        const bool is_old = std::none_of(course.movers.begin(), course.movers.end(),
                                         [&](std::uint32_t mover) { return is_concerned_[mover] != 0; });
        if (!is_old && course.stays_free(part)) continue;
        if (!is_old && !(course.gap(part) >= course.least)) blocked.push_back(kept);
        if (kept != k) courses[kept] = course;
        ++kept;
    }
    courses.resize(kept);
}

// @param makes_some whether movers in the way may still make a part
// @return whether there were any
template <class Real>
bool GuardedMove<Real>::shorten_blocked(bool makes_some) {
    std::vector<std::uint32_t> movers;
    std::fill(is_concerned_.begin(), is_concerned_.end(), std::uint8_t(0));
    for (std::size_t task = 0; task < courses_.size(); ++task) {
        for (const std::uint32_t k : blocked_[task]) {
            const PairCourse<Real>& course = courses_[task][k];
            const Real start = course.gap(
                [&](std::size_t c) { return course.approaches(c) ? Real(0) : parts_[course.movers[c]]; });
            const Real end = course.gap([&](std::size_t c) { return parts_[course.movers[c]]; });
            const Real left = makes_some ? part_left(start, end, course.least) : Real(0);
            for (std::size_t c = 0; c < 4; ++c) {
                const std::uint32_t mover = course.movers[c];
                if (std::exchange(is_concerned_[mover], std::uint8_t(1)) == 0) movers.push_back(mover);
                if (course.approaches(c))
                    next_parts_[mover] = std::min(next_parts_[mover], left * parts_[mover]);
            }
        }
    }
    for (const std::uint32_t mover : movers) parts_[mover] = next_parts_[mover];
    return !movers.empty();
}

// Islands stop whole, and colliders, each time at least one.
// @return false if none is left, where faces overlap already
template <class Real>
bool GuardedMove<Real>::stop_blocked_islands(const ContactList<Real>& list) {
    std::vector<std::uint8_t> stops(common_.size());
    for (const std::vector<PairCourse<Real>>& courses : courses_) {
        for (const PairCourse<Real>& course : courses) {
            if (course.gap([&](std::size_t c) { return parts_[course.movers[c]]; }) >= course.least) continue;
            for (const std::uint32_t mover : course.movers) stops[island_of(list, mover)] = 1;
        }
    }
    bool any = false;
    for (std::uint32_t m = 0; m < parts_.size(); ++m) {
        if (stops[island_of(list, m)] == 0 || parts_[m] == Real(0)) continue;
        parts_[m] = next_parts_[m] = Real(0);
        is_concerned_[m] = 1;
        any = true;
    }
    return any;
}

template <class Real>
std::uint32_t GuardedMove<Real>::island_of(const ContactList<Real>& list, std::uint32_t mover) const {
    return list.islands[movers_ == Movers::nodes ? object_of_[mover] : mover];
}

// What others let a body make can bring it into itself. Then it makes less, and others what that leaves them.
template <class Real>
void GuardedMove<Real>::keep_from_themselves(const ContactList<Real>& list, const ContactAims<Real>& aims,
                                             std::span<const Vec4<Real>> positions,
                                             std::span<const Vec4<Real>> ends, Closeness closeness,
                                             std::span<const std::uint8_t> is_rigid) {
    std::vector<Real> own_parts(model_->body_count());
    std::vector<Real> before;  // parts of the round before
    for (int round = 0;; ++round) {
        tbb::parallel_for(std::size_t(0), own_parts.size(), [&](std::size_t index) {
            own_parts[index] = Real(1);
            const auto o = static_cast<std::uint32_t>(index);
            if (!list.own.meets_itself(o) || (round > 0 && makes_the_same(o, before))) return;
            const Vec3<Real> common = common_[list.islands[o]];
            if (!plan_positions(o, common, positions, ends)) {
                own_.stay(o, list, common);
                return;
            }
            const bool moves_rigidly = !is_rigid.empty() && is_rigid[o] != 0 && parts_[o] == Real(1);
            if (moves_rigidly && own_.carry(o, list.own, positions, planned_)) return;
            own_parts[o] = own_.part_in_rooms(o, list.own, positions, planned_);
            if (movers_ == Movers::objects)
                own_parts[o] =
                    std::min(own_parts[o], own_.part_of_pairs(o, list, aims, positions, planned_, closeness));
            if (own_parts[o] < Real(1) && round >= kMostOwnRounds) own_parts[o] = Real(0);
        });
        if (std::all_of(own_parts.begin(), own_parts.end(), [](Real part) { return part == Real(1); }))
            return;
        before = parts_;
        for (std::uint32_t o = 0; o < own_parts.size(); ++o)
            if (own_parts[o] > Real(0) && own_parts[o] < Real(1)) own_.shorten(o, own_parts[o], list.own);
        scale_parts(own_parts);
        keep_pairs_apart(list);
    }
}

// Where the parts as they are take the body's nodes.
// @return false if none of them makes any
template <class Real>
bool GuardedMove<Real>::plan_positions(std::uint32_t object, const Vec3<Real>& common,
                                       std::span<const Vec4<Real>> positions,
                                       std::span<const Vec4<Real>> ends) {
    bool any = false;
    const Range& nodes = model_->objects[object].nodes;
    for (std::uint32_t n = nodes.first; n < nodes.end(); ++n) {
        const Real part = parts_[movers_ == Movers::nodes ? n : object];
        any |= part > Real(0);
        const Vec3<Real> position(positions[n]), motion = Vec3<Real>(ends[n]) - position - common;
        planned_[n] = Vec4<Real>(position + common + part * motion, positions[n].w);
    }
    return any;
}

template <class Real>
Range GuardedMove<Real>::movers_of(std::uint32_t object) const {
    return movers_ == Movers::nodes ? model_->objects[object].nodes : Range{object, 1};
}

template <class Real>
bool GuardedMove<Real>::makes_the_same(std::uint32_t object, const std::vector<Real>& parts) const {
    const Range movers = movers_of(object);
    return std::equal(parts_.begin() + movers.first, parts_.begin() + movers.end(),
                      parts.begin() + movers.first);
}

template <class Real>
void GuardedMove<Real>::scale_parts(std::span<const Real> by_object) {
    for (std::size_t o = 0; o < by_object.size(); ++o) {
        if (by_object[o] == Real(1)) continue;
        const Range movers = movers_of(static_cast<std::uint32_t>(o));
        for (std::uint32_t m = movers.first; m < movers.end(); ++m) parts_[m] *= by_object[o];
    }
}

template <class Real>
void GuardedMove<Real>::shorten(const ContactList<Real>& list, const ContactAims<Real>& aims,
                                std::span<const Vec4<Real>> positions, std::span<const Vec4<Real>> ends,
                                std::span<const Real> parts) {
    for_each_index(0, model_->body_count(), 1, [&](std::size_t o) {
        if (parts[o] > Real(0) && parts[o] < Real(1) && list.own.meets_itself(o))
            own_.shorten(static_cast<std::uint32_t>(o), parts[o], list.own);
    });
    scale_parts(parts);
    keep_pairs_apart(list);
    keep_from_themselves(list, aims, positions, ends, Closeness::guess);
}

template <class Real>
void GuardedMove<Real>::go(ContactList<Real>& list, std::span<const Vec4<Real>> ends, bool keeps_momentum,
                           std::span<Vec4<Real>> positions) {
    std::vector<Vec3<Real>> shifts = common_;
    if (keeps_momentum) {
        std::vector<glm::dvec3> lost(common_.size(), glm::dvec3(0.0));
        std::vector<double> masses(common_.size());
        std::vector<std::uint8_t> is_held(common_.size());
        for (std::size_t o = 0; o < model_->body_count(); ++o) {
            const std::uint32_t i = list.islands[o];
            lost[i] +=
                (masses_[o] * static_cast<double>(Real(1) - parts_[o])) * glm::dvec3(means_[o] - common_[i]);
            masses[i] += masses_[o];
            is_held[i] |= is_held_[o] | list.is_fixed[i];
        }
        for (std::size_t i = 0; i < shifts.size(); ++i) {
            if (is_held[i] != 0 || !(masses[i] > 0.0)) continue;
            const Vec3<Real> made_up(lost[i] / masses[i]);
            shifts[i] += part_within(list.shifts[i] + common_[i], made_up, list.most_shift) * made_up;
        }
    }
    tbb::parallel_for(std::size_t(0), model_->objects.size(), [&](std::size_t o) {
        const std::uint32_t island = list.islands[o];
        const Range& nodes = model_->objects[o].nodes;
        const Vec3<Real> shift = shifts[island], common = common_[island];
        if (list.own.meets_itself(o)) own_.go(static_cast<std::uint32_t>(o), shift - common, list);
        const bool are_nodes = movers_ == Movers::nodes;
        if (!are_nodes && parts_[o] == Real(1) && shift == common) {
            std::copy(ends.begin() + nodes.first, ends.begin() + nodes.end(),
                      positions.begin() + nodes.first);
            return;
        }
        for (std::uint32_t n = nodes.first; n < nodes.end(); ++n) {
            const Vec3<Real> position(positions[n]);
            const Vec3<Real> motion = Vec3<Real>(ends[n]) - position - common;
            positions[n] = Vec4<Real>(position + shift + parts_[are_nodes ? n : o] * motion, positions[n].w);
        }
    });
    for (std::size_t i = 0; i < shifts.size(); ++i) list.shifts[i] += shifts[i];
}

template class GuardedMove<float>;
template class GuardedMove<double>;

}  // namespace gelatin::cpu
