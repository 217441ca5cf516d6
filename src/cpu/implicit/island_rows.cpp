#include "cpu/implicit/island_rows.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numeric>
#include <vector>

#include "cpu/contact/tuning.h"

namespace gelatin::cpu {

template <class Real>
void IslandRows<Real>::find_tangents() const {
    for_each_index(count(), [&](std::size_t r) { tangents[r] = tangent(rows[r], slips[r]); });
}

template <class Real>
void IslandRows<Real>::find_forces() const {
    set_forces([&](std::size_t r) { return rows[r].force(slips[r]); });
}

template <class Real>
void IslandRows<Real>::find_chords(std::span<const Vec3<Real>> expected_slips) const {
    for_each_index(count(), [&](std::size_t r) {
        const ContactRow<Real>& row = rows[r];
        const Vec3<Real>& s = expected_slips[r];
        RowTangent<Real> t;
        const Real there = row.gap_at(s);
        if (std::min(row.gap, there) < row.reach) {
            const Real from = std::min(row.gap, row.reach);
            const Real to =
                row.gap > Real(0) ? std::max(there, static_cast<Real>(tuning::kChordGap) * from) : there;
            const Real force = row.force_of(from);
            Real slope = row.stiffness;
            if (to < from * Real(0.999999)) {
                slope = (row.force_of(to) - force) / (from - to);
            } else if (from < row.reach) {
                slope = row.slope_of(from);
            }
            t.constant = (force + slope * (from - row.gap)) * row.normal;
            t.stiffness.add_outer(slope + row.damping, row.normal);
        }
        if (row.limit > Real(0)) {
            ContactRow<Real> friction = row;
            friction.reach = friction.damping = Real(0);
            friction.gap = Real(1);
            const RowTangent<Real> f = tangent(friction, s);
            t.constant += f.constant;
            t.stiffness.diagonal += f.stiffness.diagonal;
            t.stiffness.beside += f.stiffness.beside;
        }
        tangents[r] = t;
    });
}

template <class Real>
void IslandRows<Real>::set_limits() const {
    for_each_index(count(), [&](std::size_t r) {
        if (!rows[r].is_tie()) rows[r].limit = rows[r].friction * rows[r].pressing(slips[r]);
    });
}

template <class Real>
double IslandRows<Real>::line_search(std::span<const Vec3<Real>> changes, double base,
                                     double curvature) const {
    constexpr std::size_t kChunk = 1024;  // of a sum
    std::vector<double> sums((count() + kChunk - 1) / kChunk);
    const auto fall = [&](double t) {  // minus the slope
        for_each_index(0, sums.size(), 1, [&](std::size_t c) {
            double sum = 0.0;
            for (std::size_t r = c * kChunk; r < std::min(count(), (c + 1) * kChunk); ++r) {
                const Vec3<Real> force = rows[r].force(slips[r] + static_cast<Real>(t) * changes[r]);
                sum += static_cast<double>(glm::dot(changes[r], force));
            }
            sums[c] = sum;
        });
        return std::accumulate(sums.begin(), sums.end(), base - t * curvature);
    };
    const double first = fall(0.0);
    if (!(first > 0.0)) return 0.0;
    if (fall(1.0) >= -tuning::kNearly * first) return 1.0;
    double low = 0.0, high = 1.0;
    for (std::uint32_t k = 0; k < tuning::kMostRounds; ++k) {
        const double middle = 0.5 * (low + high), there = fall(middle);
        if (std::abs(there) <= tuning::kNearly * first) return middle;
        (there > 0.0 ? low : high) = middle;
    }
    return 0.5 * (low + high);
}

template struct IslandRows<float>;
template struct IslandRows<double>;

}  // namespace gelatin::cpu
