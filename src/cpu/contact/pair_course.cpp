#include "cpu/contact/pair_course.h"

#include <glm/geometric.hpp>

#include "cpu/collision/nearest_points.h"

namespace gelatin::cpu {
namespace {

// Of the reach: another direction than that of the aim is taken if the pair is so far apart along it.
constexpr double kSeparated = 0.05;

// From the first side's nearest point to the second's.
template <class Real>
Vec3<Real> shortest(const ContactPair& pair, const std::array<Vec3<Real>, 4>& nodes) {
    if (pair.is_edges())
        return nearest_points<Real>(std::array{nodes[0], nodes[1]}, std::array{nodes[2], nodes[3]}).apart;
    return nearest_points<Real>(nodes[0], std::array{nodes[1], nodes[2], nodes[3]}).apart;
}

// The shortest way between the sides as seen along their relative motion. What slides over an edge is ahead
// of it now and behind it then, and above it all the time.
template <class Real>
Vec3<Real> shortest_aside(const ContactPair& pair, std::array<Vec3<Real>, 4> nodes,
                          const std::array<Vec3<Real>, 4>& motions) {
    std::array<Vec3<Real>, 2> means{Vec3<Real>(0), Vec3<Real>(0)};
    for (std::size_t k = 0; k < 4; ++k) {
        const std::uint32_t count = pair.side_of(k) == 0 ? pair.first_count : 4 - pair.first_count;
        means[pair.side_of(k)] += motions[k] / static_cast<Real>(count);
    }
    const Vec3<Real> motion = means[1] - means[0], first = nodes[0];
    const Real squared = glm::dot(motion, motion);
    if (!(squared > Real(0))) return Vec3<Real>(0);
    for (Vec3<Real>& node : nodes) node -= first + glm::dot(node - first, motion) / squared * motion;
    return shortest(pair, nodes);
}

template <class Real>
PairCourse<Real> course_along(const ContactPair& pair, const PairAim<Real>& aim, Real reach,
                              const Vec3<Real>& normal, const std::array<Vec3<Real>, 4>& nodes,
                              const std::array<Vec3<Real>, 4>& motions, Closeness closeness) {
    PairCourse<Real> course;
    course.first_count = pair.first_count;
    for (std::size_t c = 0; c < 4; ++c) {
        course.heights[c] = glm::dot(normal, nodes[c] - nodes[0]);
        course.motions[c] = glm::dot(normal, motions[c]);
    }
    const Real gap = course.gap_at(Real(0));
    const Real least = least_gap(aim, reach, gap, closeness);
    // Less what rounding makes, but never none.
    course.least = std::max({least - Real(1e-5f) * reach, Real(0.5f) * least, Real(1e-10f) * reach});
    return course;
}

}  // namespace

// Stiff contacts are not entered by a guess: it would bring energy into them that the bodies do not have.
template <class Real>
Real least_gap(const PairAim<Real>& aim, Real reach, Real gap, Closeness closeness) {
    if (closeness == Closeness::motion) return std::max(Real(0.1f) * gap, std::min(gap, Real(0.05f) * reach));
    const Real nearest = (Real(1) - Real(0.5f) * aim.yielding) * std::min(gap, reach);
    return std::max(nearest, std::min(gap, Real(0.1f) * reach));
}

// Along the direction of the aim, or along that between the nearest points where it no longer separates the
// pair; or along another one that does so all the way.
template <class Real>
PairCourse<Real> best_course(const ContactPair& pair, const PairAim<Real>& aim, Real reach,
                             const std::array<Vec3<Real>, 4>& nodes, const std::array<Vec3<Real>, 4>& motions,
                             Closeness closeness) {
    std::array<Vec3<Real>, 4> moved;
    for (std::size_t c = 0; c < 4; ++c) moved[c] = nodes[c] + motions[c];
    PairCourse<Real> course = course_along(pair, aim, reach, aim.normal, nodes, motions, closeness);
    if (!(course.gap_at(Real(0)) > Real(kSeparated) * reach)) {
        const Vec3<Real> between = shortest(pair, nodes);
        const Real length = glm::length(between);
        if (length > Real(0))
            course = course_along(pair, aim, reach, between / length, nodes, motions, closeness);
    }
    if (course.is_free()) return course;
    for (const Vec3<Real>& direction : {shortest(pair, moved), shortest_aside(pair, nodes, motions)}) {
        const Real length = glm::length(direction);
        if (!(length > Real(0))) continue;
        const PairCourse<Real> other =
            course_along(pair, aim, reach, direction / length, nodes, motions, closeness);
        if (other.is_free() && other.gap_at(Real(0)) > Real(kSeparated) * reach) return other;
    }
    return course;
}

// Between nodes a and b of the two sides, with r from a to b, the height along the direction that goes from m
// at the start to n at the end is
//   ((1 - s) m + s n) . ((1 - s) r + s r') = (1 - s)^2 m.r + s (1 - s) (m.r' + n.r) + s^2 n.r',
// positive for all s from 0 to 1 if m.r and n.r' are, and (m.r' + n.r) / 2 is above minus their geometric
// mean.
template <class Real>
Real part_apart(const ContactPair& pair, const PairAim<Real>& aim, Real reach,
                const std::array<Vec3<Real>, 4>& nodes, const std::array<Vec3<Real>, 4>& moved,
                Closeness closeness) {
    const Vec3<Real> start = shortest(pair, nodes), end = shortest(pair, moved);
    const Real gap = glm::length(start), end_gap = glm::length(end);
    const Real least = least_gap(aim, reach, gap, closeness);
    const Real left = std::max(least - Real(1e-5f) * reach, Real(0.5f) * least);
    if (!(gap > Real(0))) return Real(0);
    const Vec3<Real> m = start / gap, n = end_gap > Real(0) ? end / end_gap : m;
    bool is_apart = end_gap >= left;
    Real top = -std::numeric_limits<Real>::infinity(), low = -top, end_top = top, end_low = low;
    for (std::size_t a = 0; a < 4; ++a) {
        if (pair.side_of(a) != 0) continue;
        for (std::size_t b = 0; b < 4; ++b) {
            if (pair.side_of(b) == 0) continue;
            const Vec3<Real> r = nodes[b] - nodes[a], r_end = moved[b] - moved[a];
            const Real first = glm::dot(m, r), last = glm::dot(n, r_end);
            const Real middle = Real(0.5f) * (glm::dot(m, r_end) + glm::dot(n, r));
            is_apart = is_apart && first > Real(0) && last > Real(0) &&
                       middle > Real(-0.9f) * std::sqrt(first * last);
        }
    }
    if (is_apart) return Real(1);
    // Along the first direction, which may be too careful.
    for (std::size_t k = 0; k < 4; ++k) {
        const Real height = glm::dot(m, nodes[k] - nodes[0]), at_end = glm::dot(m, moved[k] - moved[0]);
        Real& here = pair.side_of(k) == 0 ? top : low;
        Real& there = pair.side_of(k) == 0 ? end_top : end_low;
        here = pair.side_of(k) == 0 ? std::max(here, height) : std::min(here, height);
        there = pair.side_of(k) == 0 ? std::max(there, at_end) : std::min(there, at_end);
    }
    return std::min(part_left(low - top, end_low - end_top, least), Real(0.9f));
}

template float least_gap<float>(const PairAim<float>&, float, float, Closeness);
template double least_gap<double>(const PairAim<double>&, double, double, Closeness);
template float part_apart<float>(const ContactPair&, const PairAim<float>&, float,
                                 const std::array<Vec3<float>, 4>&, const std::array<Vec3<float>, 4>&,
                                 Closeness);
template double part_apart<double>(const ContactPair&, const PairAim<double>&, double,
                                   const std::array<Vec3<double>, 4>&, const std::array<Vec3<double>, 4>&,
                                   Closeness);
template PairCourse<float> best_course<float>(const ContactPair&, const PairAim<float>&, float,
                                              const std::array<Vec3<float>, 4>&,
                                              const std::array<Vec3<float>, 4>&, Closeness);
template PairCourse<double> best_course<double>(const ContactPair&, const PairAim<double>&, double,
                                                const std::array<Vec3<double>, 4>&,
                                                const std::array<Vec3<double>, 4>&, Closeness);

}  // namespace gelatin::cpu
