#include "cpu/contact/guarded_move.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <limits>
#include <utility>

#include "cpu/collision/nearest_points.h"
#include "cpu/contact/island_motions.h"
#include "cpu/contact/planes.h"
#include "model/for_each_index.h"

namespace gelatin::cpu {
namespace {

// Rounds in which movers that block each other are shortened. After them, those still in the way make nothing
// of their own.
constexpr int kMostRounds = 8;
// What others are in the way of, but makes so much of its way, may make more after another detection if much
// is left: what slides, over the next edges.
constexpr double kProgress = 0.1;
constexpr std::size_t kPairsATask = 1024;
// Of the reach: another direction than that of the aim is taken if the pair is so far apart along it.
constexpr double kSeparated = 0.05;

// Stiff contacts are not entered by a guess: it would bring energy into them that the bodies do not have.
template <class Real>
Real least_gap(const PairAim<Real>& aim, Real reach, Real gap, Closeness closeness) {
    if (closeness == Closeness::motion) return std::max(Real(0.1f) * gap, std::min(gap, Real(0.05f) * reach));
    const Real nearest = (Real(1) - Real(0.5f) * aim.yielding) * std::min(gap, reach);
    return std::max(nearest, std::min(gap, Real(0.1f) * reach));
}

// The part of a change of a gap from `start` to `end` that leaves `least`, if the gap is concave between
// them.
template <class Real>
Real part_left(Real start, Real end, Real least) {
    if (end >= least) return Real(1);
    if (!(start > least)) return Real(0);
    return Real(0.999f) * (start - least) / (start - end);
}

// From the first side's nearest point to the second's.
template <class Real>
Vec3<Real> shortest(const ContactPair& pair, const std::array<Vec3<Real>, 4>& nodes) {
    if (pair.is_edges())
        return nearest_points<Real>(std::array{nodes[0], nodes[1]}, std::array{nodes[2], nodes[3]}).apart;
    return nearest_points<Real>(nodes[0], std::array{nodes[1], nodes[2], nodes[3]}).apart;
}

// At right angles to the face, or to both edges, and towards the second side. What slides over an edge is
// ahead of it now and behind it then, and above it all the time.
template <class Real>
Vec3<Real> across_both(const ContactPair& pair, const std::array<Vec3<Real>, 4>& nodes) {
    const Vec3<Real> across = pair.is_edges() ? glm::cross(nodes[1] - nodes[0], nodes[3] - nodes[2])
                                              : glm::cross(nodes[2] - nodes[1], nodes[3] - nodes[1]);
    return glm::dot(across, nodes[2] - nodes[0]) < Real(0) ? -across : across;
}

}  // namespace

template <class Real>
GuardedMove<Real>::GuardedMove(std::shared_ptr<const Model> model, std::vector<std::uint32_t> places)
    : model_(std::move(model)),
      places_(std::move(places)),
      object_of_(objects_of_nodes(*model_)),
      masses_(model_->objects.size()),
      is_held_(model_->objects.size()),
      means_(model_->body_count()),
      ways_(model_->node_count()),
      ways_of_objects_(model_->objects.size()),
      parts_(model_->objects.size()) {
    for (std::size_t o = 0; o < masses_.size(); ++o) {
        const Range& nodes = model_->objects[o].nodes;
        for (std::uint32_t n = nodes.first; n < nodes.end(); ++n)
            masses_[o] += static_cast<double>(model_->masses[n]);
    }
}

template <class Real>
void GuardedMove<Real>::begin(std::span<const Vec4<Real>> positions) {
    for (std::size_t o = 0; o < is_held_.size(); ++o) {
        const Range& nodes = model_->objects[o].nodes;
        const auto own = positions.subspan(nodes.first, nodes.count);
        is_held_[o] = std::any_of(own.begin(), own.end(), [](const auto& p) { return p.w == Real(0); });
    }
}

template <class Real>
bool GuardedMove<Real>::plan(const ContactList<Real>& list, const ContactAims<Real>& aims,
                             std::span<const Vec4<Real>> positions, std::span<const Vec4<Real>> ends,
                             Closeness closeness, Movers movers) {
    movers_ = movers;
    common_.assign(list.shifts.size(), Vec3<Real>(0));
    if (movers == Movers::objects) find_common_motions(list, positions, ends);
    const bool may_shift = limit_common_motions(list);
    keep_to_rooms(list, aims, positions, ends);
    room_parts_ = parts_;
    find_courses(list, aims, positions, ends, closeness);
    keep_pairs_apart(list);
    if (movers == Movers::nodes) return true;
    const auto goes_on = [&](std::size_t o) {
        if (parts_[o] == Real(1)) return false;
        if (parts_[o] == room_parts_[o]) return true;
        const Real left = (Real(1) - parts_[o]) * ways_of_objects_[o];
        return parts_[o] > Real(kProgress) && left > aims.thickness(o);
    };
    for (std::size_t o = 0; o < parts_.size(); ++o)
        if (goes_on(o)) return false;
    return may_shift;
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
        const Course course =
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
    tbb::parallel_for(std::size_t(0), model_->objects.size(), [&](std::size_t o) {
        const std::uint32_t island = list.islands[o];
        const Range& nodes = model_->objects[o].nodes;
        ways_of_objects_[o] = Real(0);
        for (std::uint32_t n = nodes.first; n < nodes.end(); ++n) {
            // The nodes of a handle keep their shape: they go on with whole objects alone.
            if (are_nodes && positions[n].w == Real(0)) parts_[n] = Real(0);
            const std::uint32_t place = places_[n];
            if (place == kNoNode) continue;
            const Vec3<Real> position(positions[n]);
            const Vec3<Real> motion = Vec3<Real>(ends[n]) - position - common_[island];
            const Vec3<Real> moved = list.moved(place, static_cast<std::uint32_t>(o), position);
            Real& part = parts_[are_nodes ? n : o];
            part = std::min(part, list.part_within_room(place, moved, motion));
            const Real way = glm::length(motion);
            ways_[n] = glm::length(position - aims.nodes().aimed_at(n)) + way;
            ways_of_objects_[o] = std::max(ways_of_objects_[o], way);
        }
    });
}

template <class Real>
void GuardedMove<Real>::find_courses(const ContactList<Real>& list, const ContactAims<Real>& aims,
                                     std::span<const Vec4<Real>> positions, std::span<const Vec4<Real>> ends,
                                     Closeness closeness) {
    found_.resize((list.pairs.size() + kPairsATask - 1) / kPairsATask);
    for_each_index(0, found_.size(), 1, [&](std::size_t task) {
        found_[task].clear();
        const std::size_t end = std::min((task + 1) * kPairsATask, list.pairs.size());
        for (std::size_t p = task * kPairsATask; p < end; ++p) {
            if (are_far_apart(list.pairs[p], aims, aims.aims()[p], closeness)) continue;
            const ContactPair& pair = list.pairs[p];
            const Vec3<Real> common = common_[list.island_of(pair)];
            std::array<Vec3<Real>, 4> nodes, motions;
            for (std::size_t c = 0; c < 4; ++c) {
                nodes[c] = Vec3<Real>(positions[pair.nodes[c]]);
                motions[c] = Vec3<Real>(ends[pair.nodes[c]]) - nodes[c] - common;
            }
            const Course course =
                best_course(pair, aims.aims()[p], aims.reach(pair), nodes, motions, closeness);
            if (!course.stays_free([](std::size_t) { return Real(1); })) found_[task].push_back(course);
        }
    });
    courses_.clear();
    for (const std::vector<Course>& found : found_)
        courses_.insert(courses_.end(), found.begin(), found.end());
}

// Most pairs are too far apart for the ways of their nodes.
template <class Real>
bool GuardedMove<Real>::are_far_apart(const ContactPair& pair, const ContactAims<Real>& aims,
                                      const PairAim<Real>& aim, Closeness closeness) const {
    std::array<Real, 2> ways{};
    for (std::size_t k = 0; k < 4; ++k) {
        Real& way = ways[pair.side_of(k)];
        way = std::max(way, ways_[pair.nodes[k]]);
    }
    return aim.gap - ways[0] - ways[1] > least_gap(aim, aims.reach(pair), aim.gap, closeness);
}

// Along the direction of the aim, or along that between the nearest points where it no longer separates the
// pair; or along another one that does so all the way.
template <class Real>
typename GuardedMove<Real>::Course GuardedMove<Real>::best_course(const ContactPair& pair,
                                                                  const PairAim<Real>& aim, Real reach,
                                                                  const std::array<Vec3<Real>, 4>& nodes,
                                                                  const std::array<Vec3<Real>, 4>& motions,
                                                                  Closeness closeness) const {
    std::array<Vec3<Real>, 4> moved;
    for (std::size_t c = 0; c < 4; ++c) moved[c] = nodes[c] + motions[c];
    Course course = course_along(pair, aim, reach, aim.normal, nodes, motions, closeness);
    if (!(course.gap_at(Real(0)) > Real(kSeparated) * reach)) {
        const Vec3<Real> between = shortest(pair, nodes);
        const Real length = glm::length(between);
        if (length > Real(0))
            course = course_along(pair, aim, reach, between / length, nodes, motions, closeness);
    }
    if (course.is_free()) return course;
    for (const Vec3<Real>& direction : {shortest(pair, moved), across_both(pair, nodes)}) {
        const Real length = glm::length(direction);
        if (!(length > Real(0))) continue;
        const Course other = course_along(pair, aim, reach, direction / length, nodes, motions, closeness);
        if (other.is_free() && other.gap_at(Real(0)) > Real(kSeparated) * reach) return other;
    }
    return course;
}

template <class Real>
typename GuardedMove<Real>::Course GuardedMove<Real>::course_along(const ContactPair& pair,
                                                                   const PairAim<Real>& aim, Real reach,
                                                                   const Vec3<Real>& normal,
                                                                   const std::array<Vec3<Real>, 4>& nodes,
                                                                   const std::array<Vec3<Real>, 4>& motions,
                                                                   Closeness closeness) const {
    Course course;
    course.first_count = pair.first_count;
    for (std::size_t c = 0; c < 4; ++c) {
        course.movers[c] = movers_ == Movers::nodes ? pair.nodes[c]
                           : pair.side_of(c) == 0   ? pair.object
                                                    : pair.other;
        course.heights[c] = glm::dot(normal, nodes[c] - nodes[0]);
        course.motions[c] = glm::dot(normal, motions[c]);
    }
    const Real gap = course.gap_at(Real(0));
    const Real least = least_gap(aim, reach, gap, closeness);
    // Less what rounding makes, but never none.
    course.least = std::max({least - Real(1e-5f) * reach, Real(0.5f) * least, Real(1e-10f) * reach});
    return course;
}

template <class Real>
template <class Part>
Real GuardedMove<Real>::Course::gap(const Part& part) const {
    Real top = -std::numeric_limits<Real>::infinity(), low = -top;
    for (std::size_t k = 0; k < 4; ++k) {
        const Real height = heights[k] + part(k) * motions[k];
        if (k < first_count) {
            top = std::max(top, height);
        } else {
            low = std::min(low, height);
        }
    }
    return low - top;
}

template <class Real>
template <class Part>
bool GuardedMove<Real>::Course::stays_free(const Part& part) const {
    return gap([&](std::size_t k) { return approaches(k) ? part(k) : Real(0); }) >= least;
}

// In each round every pair that would come too near shortens the movers that approach.
template <class Real>
void GuardedMove<Real>::keep_pairs_apart(const ContactList<Real>& list) {
    const auto is_left = [&](const Course& course) {
        return course.gap([&](std::size_t k) { return parts_[course.movers[k]]; }) >= course.least;
    };
    for (int round = 0;; ++round) {
        bool is_blocked = false;
        next_parts_ = parts_;
        std::size_t kept = 0;
        for (std::size_t k = 0; k < courses_.size(); ++k) {
            const Course course = courses_[k];
            if (course.stays_free([&](std::size_t c) { return parts_[course.movers[c]]; })) continue;
            courses_[kept++] = course;
            if (is_left(course)) continue;
            is_blocked = true;
            const Real start = course.gap(
                [&](std::size_t c) { return course.approaches(c) ? Real(0) : parts_[course.movers[c]]; });
            const Real end = course.gap([&](std::size_t c) { return parts_[course.movers[c]]; });
            const Real left = round < kMostRounds ? part_left(start, end, course.least) : Real(0);
            for (std::size_t c = 0; c < 4; ++c) {
                Real& part = next_parts_[course.movers[c]];
                if (course.approaches(c)) part = std::min(part, left * parts_[course.movers[c]]);
            }
        }
        courses_.resize(kept);
        std::swap(parts_, next_parts_);
        if (!is_blocked) return;
        // In a large island rounds could go on from body to body. Islands stop whole, and colliders, each
        // time at least one.
        if (round < 2 * kMostRounds) continue;
        std::vector<std::uint8_t> stops(common_.size());
        for (const Course& course : courses_) {
            if (is_left(course)) continue;
            for (const std::uint32_t mover : course.movers) stops[island_of(list, mover)] = 1;
        }
        for (std::uint32_t m = 0; m < parts_.size(); ++m)
            if (stops[island_of(list, m)] != 0) parts_[m] = Real(0);
    }
}

template <class Real>
std::uint32_t GuardedMove<Real>::island_of(const ContactList<Real>& list, std::uint32_t mover) const {
    return list.islands[movers_ == Movers::nodes ? object_of_[mover] : mover];
}

template <class Real>
void GuardedMove<Real>::shorten(const ContactList<Real>& list, std::span<const Real> parts) {
    for (std::size_t o = 0; o < parts.size(); ++o) {
        const Range& nodes = model_->objects[o].nodes;
        for (std::uint32_t n = nodes.first; n < nodes.end(); ++n) parts_[n] *= parts[o];
    }
    keep_pairs_apart(list);
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
