#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>

#include "cpu/contact/contact_aims.h"
#include "cpu/contact/contact_list.h"
#include "cpu/nodes.h"

namespace gelatin::cpu {

/// How near to each other a move may bring two surfaces.
enum class Closeness {
    guess,   ///< half of the reach, or of the gap, is left for what follows
    motion,  ///< a tenth of the gap
};

/// A pair's nodes on their ways, along a direction from its first side to its second.
template <class Real>
struct PairCourse {
    std::array<Real, 4> heights, motions;  ///< of its nodes, from the first one [m]
    Real least;                            ///< gap that must be left [m]
    std::uint32_t first_count;             ///< nodes of the first side
    std::array<std::uint32_t, 4> movers;   ///< what makes parts of its motions (GuardedMove)

    bool approaches(std::size_t k) const { return k < first_count ? motions[k] > 0 : motions[k] < 0; }
    /// The gap when each node makes a part of its motion. @param part of node k
    template <class Part>
    Real gap(const Part& part) const;
    Real gap_at(Real part) const {
        return gap([&](std::size_t) { return part; });
    }
    bool is_free() const { return gap_at(Real(1)) >= least; }
    /// Whether the gap is left by all parts up to these: the worst is that nothing but what approaches moves.
    template <class Part>
    bool stays_free(const Part& part) const;
};

/// Along the direction of the aim, or along that between the nearest points where it no longer separates the
/// pair; or along another one that does so all the way.
/// @param nodes positions of the pair's nodes @param motions of them [m]
template <class Real>
PairCourse<Real> best_course(const ContactPair& pair, const PairAim<Real>& aim, Real reach,
                             const std::array<Vec3<Real>, 4>& nodes, const std::array<Vec3<Real>, 4>& motions,
                             Closeness closeness);

/// The part of a motion that leaves a gap of a pair, if all its nodes make the same part. The direction that
/// separates it may turn on the way.
template <class Real>
Real part_apart(const ContactPair& pair, const PairAim<Real>& aim, Real reach,
                const std::array<Vec3<Real>, 4>& nodes, const std::array<Vec3<Real>, 4>& moved,
                Closeness closeness);

/// The gap that a move has to leave of one [m].
template <class Real>
Real least_gap(const PairAim<Real>& aim, Real reach, Real gap, Closeness closeness);

/// The part of a change of a gap from `start` to `end` that leaves `least`, if the gap is concave between
/// them.
template <class Real>
Real part_left(Real start, Real end, Real least) {
    if (end >= least) return Real(1);
    if (!(start > least)) return Real(0);
    return Real(0.999f) * (start - least) / (start - end);
}

template <class Real>
template <class Part>
Real PairCourse<Real>::gap(const Part& part) const {
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
bool PairCourse<Real>::stays_free(const Part& part) const {
    return gap([&](std::size_t k) { return approaches(k) ? part(k) : Real(0); }) >= least;
}

}  // namespace gelatin::cpu
