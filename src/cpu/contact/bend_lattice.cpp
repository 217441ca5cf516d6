#include "cpu/contact/bend_lattice.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <utility>

#include "cpu/contact/least_stretch.h"
#include "model/spring_packing.h"

namespace gelatin::cpu {
namespace {

// A lattice has no more cells than this along an axis.
constexpr double kMostCells = 16.0;
// In cells: how far it is wider than what it surrounds.
constexpr double kMargin = 0.25;
constexpr int kFillings = 6;
// Passes over cells, each of which is made flatter; what is left, all bends share.
constexpr int kFlattenings = 4;
// What each is made as flat as, of what is allowed: B-splines are bounded by what is beside, too.
constexpr double kFlattened = 0.8;

}  // namespace

template <class Real>
void BendLattice<Real>::surround(std::span<const Vec3<Real>> offsets, Real cell) {
    Vec3<Real> low(std::numeric_limits<Real>::infinity()), high(-low);
    for (const Vec3<Real>& offset : offsets) {
        low = glm::min(low, offset);
        high = glm::max(high, offset);
    }
    const Vec3<Real> size = high - low;
    cell_ = std::max(cell, std::max({size.x, size.y, size.z}) / static_cast<Real>(kMostCells));
    for (int axis = 0; axis < 3; ++axis)
        points_[axis] = 3 + static_cast<std::uint32_t>(size[axis] / cell_ + static_cast<Real>(2.0 * kMargin));
    low_ = Real(0.5f) * (low + high - cell_ * Vec3<Real>(points_ - 1u));
    weights_.assign(std::size_t(points_.x) * points_.y * points_.z, Real(0));
    used_.clear();
    numbers_.assign(weights_.size(), kNoNode);
}

template <class Real>
bool BendLattice<Real>::contains(const Vec3<Real>& offset) const {
    const Vec3<Real> in_cells = (offset - low_) / cell_, last(points_ - 1u);
    for (int axis = 0; axis < 3; ++axis)
        if (!(in_cells[axis] >= Real(0.5f) && in_cells[axis] <= last[axis] - Real(0.5f))) return false;
    return true;
}

template <class Real>
typename BendLattice<Real>::Place BendLattice<Real>::place(const Vec3<Real>& offset) {
    const Vec3<Real> in_cells = (offset - low_) / cell_;
    glm::uvec3 first(0);
    for (int axis = 0; axis < 3; ++axis) {
        const auto last = static_cast<Real>(points_[axis] - 2);
        // At least 1, even of what is not a number, so that there are points on all sides.
        const Real in_range = std::clamp(in_cells[axis] + Real(0.5f), Real(1), last);
        first[axis] = in_range > Real(1) ? static_cast<std::uint32_t>(in_range) : 1u;
    }
    const std::uint32_t point = first.x + points_.x * (first.y + points_.y * first.z);
    if (numbers_[point] == kNoNode) {
        numbers_[point] = static_cast<std::uint32_t>(used_.size());
        used_.push_back(point);
    }
    return {point, numbers_[point], first,
            glm::clamp(in_cells - Vec3<Real>(first), Vec3<Real>(-0.5f), Vec3<Real>(0.5f))};
}

template <class Real>
void BendLattice<Real>::weigh(std::span<const Place> places) {
    std::fill(weights_.begin(), weights_.end(), Real(0));
    for (const Place& place : places)
        for_points(place, [&](std::size_t p, Real weight) { weights_[p] += weight; });
}

template <class Real>
void BendLattice<Real>::fill_empty(Bends& bends) const {
    const glm::ivec3 points(points_);
    const std::array<std::size_t, 3> steps = strides();
    for (int filling = 0; filling < kFillings; ++filling) {
        std::size_t index = 0;
        glm::ivec3 p(0);
        for (p.z = 0; p.z < points.z; ++p.z)
            for (p.y = 0; p.y < points.y; ++p.y)
                for (p.x = 0; p.x < points.x; ++p.x, ++index) {
                    if (weights_[index] > Real(0)) continue;
                    Vec4<Real> sum(0);
                    Real count = 0;
                    for (int axis = 0; axis < 3; ++axis) {
                        const std::size_t step = steps[static_cast<std::size_t>(axis)];
                        if (p[axis] > 0) {
                            sum += bends[index - step];
                            count += Real(1);
                        }
                        if (p[axis] + 1 < points[axis]) {
                            sum += bends[index + step];
                            count += Real(1);
                        }
                    }
                    bends[index] = sum / count;
                }
    }
}

// use(first point) for each cell.
template <class Real>
template <class Use>
void BendLattice<Real>::for_cells(const Use& use) const {
    const std::array<std::size_t, 3> steps = strides();
    for (std::uint32_t z = 0; z + 1 < points_.z; ++z)
        for (std::uint32_t y = 0; y + 1 < points_.y; ++y)
            for (std::uint32_t x = 0; x + 1 < points_.x; ++x) use(x + y * steps[1] + z * steps[2]);
}

// Of the edges between eight points, the steepest along each axis. In units of the cell.
template <class Real>
Real BendLattice<Real>::squared_slope(const Bends& bends, std::size_t first) const {
    const std::array<std::size_t, 3> steps = strides();
    Real squared = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const std::size_t along = steps[axis], a = steps[(axis + 1) % 3], b = steps[(axis + 2) % 3];
        Real steep = 0;
        for (const std::size_t p : {first, first + a, first + b, first + a + b}) {
            const Vec4<Real> change = bends[p + along] - bends[p];
            steep = std::max(steep, glm::dot(change, change));
        }
        squared += steep;
    }
    return squared;
}

// Of B-splines, where the slope along each axis is between those of edges up to one point away.
template <class Real>
Real BendLattice<Real>::steepest(const Bends& bends) const {
    const std::array<std::size_t, 3> steps = strides();
    std::vector<Real> sums(bends.size(), Real(0)), low(bends.size(), Real(0)), high(bends.size());
    for (std::size_t axis = 0; axis < 3; ++axis) {
        std::fill(high.begin(), high.end(), Real(0));
        glm::uvec3 ends = points_;
        --ends[static_cast<int>(axis)];
        for (std::uint32_t z = 0; z < ends.z; ++z)
            for (std::uint32_t y = 0; y < ends.y; ++y)
                for (std::uint32_t x = 0; x < ends.x; ++x) {
                    const std::size_t p = x + y * steps[1] + z * steps[2];
                    const Vec4<Real> change = bends[p + steps[axis]] - bends[p];
                    high[p] = glm::dot(change, change);
                }
        for (std::size_t across = 0; across < 3; ++across)
            widen(low, high, across, -1, across == axis ? 0 : 1);
        for (std::size_t p = 0; p < sums.size(); ++p) sums[p] += high[p];
    }
    return std::sqrt(*std::max_element(sums.begin(), sums.end())) / cell_;
}

// Those of a cell's points differ by less from their mean.
template <class Real>
void BendLattice<Real>::shrink(Bends& bends, std::size_t first, Real part) const {
    const std::array<std::size_t, 3> steps = strides();
    std::array<std::size_t, 8> corners{};
    Vec4<Real> mean(0);
    for (std::size_t k = 0; k < 8; ++k) {
        corners[k] = first + (k & 1) * steps[0] + (k >> 1 & 1) * steps[1] + (k >> 2) * steps[2];
        mean += Real(0.125f) * bends[corners[k]];
    }
    for (const std::size_t p : corners) bends[p] = mean + part * (bends[p] - mean);
}

// Cell by cell, so that what is steep somewhere hardly changes what is elsewhere.
template <class Real>
bool BendLattice<Real>::flatten(Bends& bends, Real most) const {
    const Real aim = static_cast<Real>(kFlattened) * most * cell_, enough = aim * aim;
    Real slope = steepest(bends);
    if (!(slope > most)) return false;
    for (int flattening = 0; flattening < kFlattenings && slope > most; ++flattening) {
        for_cells([&](std::size_t first) {
            const Real squared = squared_slope(bends, first);
            if (squared > enough) shrink(bends, first, std::sqrt(enough / squared));
        });
        slope = steepest(bends);
    }
    if (slope > most)
        for (Vec4<Real>& bend : bends) bend *= Real(0.999f) * most / slope;
    return true;
}

// The least of `low` and the greatest of `high` from `first` to `last` points after each along an axis.
template <class Real>
void BendLattice<Real>::widen(std::vector<Real>& low, std::vector<Real>& high, std::size_t axis, int first,
                              int last) const {
    const std::vector<Real> lows = low, highs = high;
    const glm::ivec3 points(points_);
    const std::array<std::size_t, 3> steps = strides();
    const auto along = static_cast<int>(axis);
    for (int d = first; d <= last; ++d) {
        if (d == 0) continue;
        glm::ivec3 from(0), end = points;
        from[along] = std::max(0, -d);
        end[along] = points[along] - std::max(0, d);
        const auto offset = static_cast<std::ptrdiff_t>(steps[axis]) * d;
        for (int z = from.z; z < end.z; ++z)
            for (int y = from.y; y < end.y; ++y) {
                const auto row =
                    static_cast<std::ptrdiff_t>(steps[1]) * y + static_cast<std::ptrdiff_t>(steps[2]) * z;
                for (std::ptrdiff_t p = row + from.x; p < row + end.x; ++p) {
                    const auto here = static_cast<std::size_t>(p),
                               there = static_cast<std::size_t>(p + offset);
                    low[here] = std::min(low[here], lows[there]);
                    high[here] = std::max(high[here], highs[there]);
                }
            }
    }
}

// The linear interpolation of a function in a triangle is no farther from it than its second derivative along
// any direction times a sixth of the longest edge squared.
template <class Real>
Real BendLattice<Real>::bulge(const Bends& bends, Curvatures& curvatures,
                              const std::array<const Place*, 3>& corners, Real longest_edge) const {
    if (curvatures.cells.empty()) curvatures = find_differences(bends);
    const auto [a, b, c] = corners;
    Real most = 0;
    for (const Place* corner : corners) {
        Real& known = curvatures.cells[corner->used];
        if (known < Real(0)) known = curvature(curvatures, corner->point);
        most = std::max(most, known);
    }
    const glm::uvec3 first = glm::min(a->cell, glm::min(b->cell, c->cell)),
                     last = glm::max(a->cell, glm::max(b->cell, c->cell)), size = last - first;
    if (size.x + size.y + size.z > 1)  // more cells than those of the corners
        for (std::uint32_t z = first.z; z <= last.z; ++z)
            for (std::uint32_t y = first.y; y <= last.y; ++y)
                for (std::uint32_t x = first.x; x <= last.x; ++x)
                    most = std::max(most,
                                    curvature(curvatures, x + points_.x * (y + points_.y * std::size_t(z))));
    return longest_edge * longest_edge * most / Real(6);
}

// Second differences: a bow of three points along an axis, a twist of four round a square across it.
template <class Real>
typename BendLattice<Real>::Curvatures BendLattice<Real>::find_differences(const Bends& bends) const {
    Curvatures found;
    found.cells.assign(used_.size(), Real(-1));
    const std::array<std::size_t, 3> steps = strides();
    const auto squared = [](const Vec4<Real>& v) { return glm::dot(v, v); };
    const auto fill = [&](std::vector<Real>& values, const glm::uvec3& first, const glm::uvec3& end,
                          const auto& value) {
        values.assign(bends.size(), Real(0));
        for (std::uint32_t z = first.z; z < end.z; ++z)
            for (std::uint32_t y = first.y; y < end.y; ++y)
                for (std::uint32_t x = first.x; x < end.x; ++x) {
                    const std::size_t p = x + y * steps[1] + z * steps[2];
                    values[p] = value(p);
                }
    };
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const std::size_t s = steps[axis], a = steps[(axis + 1) % 3], b = steps[(axis + 2) % 3];
        glm::uvec3 inner(0), low = points_, square = points_ - 1u;
        inner[static_cast<int>(axis)] = 1;
        --low[static_cast<int>(axis)];
        ++square[static_cast<int>(axis)];
        fill(found.bows[axis], inner, low,
             [&](std::size_t p) { return squared(bends[p + s] - Real(2) * bends[p] + bends[p - s]); });
        fill(found.twists[axis], glm::uvec3(0), square, [&](std::size_t p) {
            return squared((bends[p + a + b] - bends[p + a]) - (bends[p + b] - bends[p]));
        });
    }
    return found;
}

// Along each pair of axes second derivatives are between second differences of the points round a cell. Of
// the matrix of their lengths, the norm bounds them along any direction.
template <class Real>
Real BendLattice<Real>::curvature(const Curvatures& curvatures, std::size_t point) const {
    const std::array<std::size_t, 3> steps = strides();
    Real squared = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const std::size_t s = steps[axis], a = steps[(axis + 1) % 3], b = steps[(axis + 2) % 3];
        const std::size_t corner = point - a - b;
        const std::vector<Real>&bows = curvatures.bows[axis], &twists = curvatures.twists[axis];
        Real bow = 0, twist = 0;
        for (std::size_t i = 0; i < 3; ++i)
            for (std::size_t j = 0; j < 3; ++j) bow = std::max(bow, bows[corner + i * a + j * b]);
        for (std::size_t k = 0; k < 3; ++k)
            for (std::size_t i = 0; i < 2; ++i)
                for (std::size_t j = 0; j < 2; ++j)
                    twist = std::max(twist, twists[corner + k * s - s + i * a + j * b]);
        squared += bow + Real(2) * twist;
    }
    return std::sqrt(squared) / (cell_ * cell_);
}

// In a cell and those round it, slopes along an axis are between those of edges up to two points away.
template <class Real>
std::vector<LocalMap<Real>> BendLattice<Real>::local_maps(const glm::mat<3, 3, Real>& linear,
                                                          const Bends& bends) const {
    std::vector<LocalMap<Real>> maps(used_.size(), {linear, Real(1), Real(0)});
    const std::array<std::size_t, 3> steps = strides();
    std::vector<Real> low(bends.size()), high(bends.size());
    for (std::size_t axis = 0; axis < 3; ++axis) {
        for (int c = 0; c < 3; ++c) {
            std::fill(low.begin(), low.end(), std::numeric_limits<Real>::infinity());
            std::fill(high.begin(), high.end(), -std::numeric_limits<Real>::infinity());
            glm::uvec3 ends = points_;
            --ends[static_cast<int>(axis)];
            for (std::uint32_t z = 0; z < ends.z; ++z)
                for (std::uint32_t y = 0; y < ends.y; ++y)
                    for (std::uint32_t x = 0; x < ends.x; ++x) {
                        const std::size_t p = x + y * steps[1] + z * steps[2];
                        low[p] = high[p] = (bends[p + steps[axis]][c] - bends[p][c]) / cell_;
                    }
            for (std::size_t across = 0; across < 3; ++across)
                widen(low, high, across, -2, across == axis ? 1 : 2);
            for (std::size_t k = 0; k < used_.size(); ++k) {
                const Real half = Real(0.5f) * (high[used_[k]] - low[used_[k]]);
                maps[k].linear[static_cast<int>(axis)][c] += low[used_[k]] + half;
                maps[k].spread += half * half;
            }
        }
    }
    for (LocalMap<Real>& map : maps) {
        map.least = least_stretch(map.linear);
        map.spread = std::sqrt(map.spread);
    }
    return maps;
}

template class BendLattice<float>;
template class BendLattice<double>;

}  // namespace gelatin::cpu
