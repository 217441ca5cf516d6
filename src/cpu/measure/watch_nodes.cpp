#include "cpu/measure/watch_nodes.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_reduce.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

namespace gelatin::cpu {
namespace {

// The result for a range of nodes.
struct Found {
    std::uint32_t node = kNoAlarm.node, count = 0, speed = 0;
};

Found both(const Found& a, const Found& b) {
    return {std::min(a.node, b.node), a.count + b.count, std::max(a.speed, b.speed)};
}

template <class Real>
bool is_finite(const Vec4<Real>& v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

// Half the square of its speed: the kinetic energy of one kilogram.
template <class Real>
Real specific_energy(const Vec4<Real>& velocity) {
    return Real(0.5) * glm::dot(Vec3<Real>(velocity), Vec3<Real>(velocity));
}

// True for nearly all nodes, without a branch. What is not finite fails the comparison, because zero times
// infinity is not a number.
template <class Real>
bool is_well(const Vec4<Real>& position, const Vec4<Real>& velocity, Real most_energy) {
    const Vec4<Real> zero = Real(0) * position;
    return specific_energy(velocity) + zero.x + zero.y + zero.z <= most_energy * position.w;
}

template <class Real>
Found look_closer(const Vec4<Real>& position, const Vec4<Real>& velocity, Real most_energy, std::uint32_t n) {
    const bool finite = is_finite(position) && is_finite(velocity);
    const bool pinned = position.w == Real(0);
    if (finite && (pinned || specific_energy(velocity) <= most_energy * position.w)) return {};
    const float speed = finite ? static_cast<float>(glm::length(Vec3<Real>(velocity)))
                               : std::numeric_limits<float>::quiet_NaN();
    return {n, 1, std::bit_cast<std::uint32_t>(speed)};
}

}  // namespace

template <class Real>
void watch_nodes(const Nodes<Real>& nodes, std::uint32_t step_number, Real most_energy, Alarm& alarm) {
    if (alarm.count > 0) return;
    constexpr std::uint32_t kNodesATask = 4096, kBlock = 64;
    const auto count = static_cast<std::uint32_t>(nodes.positions.size());
    const Found found = tbb::parallel_reduce(
        tbb::blocked_range<std::uint32_t>(0, count, kNodesATask), Found{},
        [&](const auto& range, Found sum) {
            for (std::uint32_t first = range.begin(); first < range.end(); first += kBlock) {
                const std::uint32_t end = std::min(first + kBlock, range.end());
                bool well = true;
                for (std::uint32_t n = first; n < end; ++n)
                    well &= is_well(nodes.positions[n], nodes.velocities[n], most_energy);
                for (std::uint32_t n = first; !well && n < end; ++n)
                    sum = both(sum, look_closer(nodes.positions[n], nodes.velocities[n], most_energy, n));
            }
            return sum;
        },
        both);
    if (found.count > 0) alarm = {step_number, found.node, found.count, found.speed};
}

template void watch_nodes<float>(const Nodes<float>&, std::uint32_t, float, Alarm&);
template void watch_nodes<double>(const Nodes<double>&, std::uint32_t, double, Alarm&);

}  // namespace gelatin::cpu
