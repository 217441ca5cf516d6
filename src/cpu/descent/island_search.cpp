#include "cpu/descent/island_search.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>
#include <limits>

#include "core/disjoint_sets.h"
#include "model/for_each_index.h"

namespace gelatin::cpu {
namespace {

using Touch = IslandSystem::Touch;

// The line search ends when the slope is this small, of that at the start, or after so many looks.
constexpr double kLevel = 1e-3;
constexpr int kMostLooks = 16;
// Each thread takes at least so many at a time.
constexpr std::size_t kBodiesATask = 64, kTouchesATask = 512;

// Of an energy, by the part that is made of a motion.
struct Slope {
    double value = 0.0, change = 0.0;  // [J]

    void operator+=(const Slope& other) {
        value += other.value;
        change += other.change;
    }
};

// A contact on the way of its bodies.
class Course {
public:
    Course() = default;
    Course(const Touch& touch, const std::vector<Motion>& way) : touch_(&touch) {
        const glm::dvec3 moved = IslandSystem::apart(touch, way);
        change_ = glm::dot(moved, touch.normal);
        const glm::dvec3 slip = moved - change_ * touch.normal;
        held_squared_ = glm::dot(touch.hold, touch.hold);
        held_along_ = glm::dot(touch.hold, slip);
        slip_squared_ = glm::dot(slip, slip);
        is_between_ = touch.bodies[0] != kNoNode && touch.bodies[1] != kNoNode;
        if (!is_between_) return;
        for (std::size_t side = 0; side < 2; ++side)
            sides_[side] = glm::dot(touch.displacement(side, way[touch.bodies[side]]), touch.normal);
    }

    bool acts() const {
        return std::min(touch_->gap, touch_->gap + change_) < touch_->reach || touch_->limit > 0.0;
    }
    // Whether it would if its bodies made different parts.
    bool may_act() const {
        return is_between_ &&
               touch_->gap + std::min(sides_[1], 0.0) - std::max(sides_[0], 0.0) < touch_->reach;
    }
    double gap_after(double first_part, double second_part) const {
        return touch_->gap + second_part * sides_[1] - first_part * sides_[0];
    }

    Slope slope_at(double part) const {
        const double gap = touch_->gap + part * change_;
        const Slope slope{-touch_->force_at(gap) * change_, touch_->hessian_at(gap) * change_ * change_};
        if (!(touch_->limit > 0.0)) return slope;
        const double way = part * touch_->stiffness;  // of what would hold, by the slip
        const double along = held_along_ + way * slip_squared_;
        const double squared = held_squared_ + way * (held_along_ + along);
        const bool slides = squared > touch_->limit * touch_->limit;
        const double share = slides ? touch_->limit / std::sqrt(squared) : 1.0;
        const double turning = slip_squared_ - (slides ? along * along / squared : 0.0);
        return {slope.value + share * along, slope.change + share * touch_->stiffness * turning};
    }

private:
    const Touch* touch_ = nullptr;
    bool is_between_ = false;        // two bodies
    double change_ = 0.0;            // of the gap [m]
    std::array<double, 2> sides_{};  // how far each goes along the normal, if it is between two [m]
    double held_squared_ = 0.0, held_along_ = 0.0, slip_squared_ = 0.0;
};

// The part of a way at which an energy is least. @param slope_at(part): its slope
template <class SlopeAt>
double least_part(const SlopeAt& slope_at) {
    const double enough = kLevel * std::abs(slope_at(0.0).value);
    double low = 0.0, high = 1.0, part = 1.0, last = std::numeric_limits<double>::infinity();
    for (int i = 0; i < kMostLooks; ++i) {
        const Slope slope = slope_at(part);
        const double steepness = std::abs(slope.value);
        if (steepness <= enough || (part == 1.0 && !(slope.value > 0.0))) return part;
        (slope.value > 0.0 ? high : low) = part;
        part -= slope.value / slope.change;
        // Deep within reach, where forces rise steeply, Newton's steps are short.
        if (!(part > low && part < high) || steepness > 0.5 * last) part = 0.5 * (low + high);
        last = steepness;
    }
    return low;
}

}  // namespace

// Newton's step alone would throw bodies through the reach of others, and friction would move them farther
// than what they lie on. In a crowd the first to meet would stop all, if all made the same part.
std::vector<double> least_parts(const IslandSystem& island, std::span<const Motion> motions,
                                const std::vector<Motion>& way) {
    const std::vector<Touch>& touches = island.touches;
    std::vector<Course> courses(touches.size());
    for_each_index(0, touches.size(), kTouchesATask,
                   [&](std::size_t k) { courses[k] = Course(touches[k], way); });
    std::vector<std::uint32_t> acting, waiting;
    for (std::uint32_t k = 0; k < courses.size(); ++k) {
        if (courses[k].acts()) acting.push_back(k);
        if (!courses[k].acts() && courses[k].may_act()) waiting.push_back(k);
    }
    DisjointSets groups(island.bodies.size());
    const auto unite = [&](std::uint32_t touch) {
        const auto [a, b] = touches[touch].bodies;
        return a != kNoNode && b != kNoNode && groups.unite(a, b);
    };
    for (const std::uint32_t k : acting) unite(k);
    std::vector<double> parts(island.bodies.size());
    std::vector<std::uint8_t> is_new(island.bodies.size(), 1);  // by the least number of a group
    // Of a group, with the contacts that act in it.
    const auto find_part = [&](const std::vector<std::uint32_t>& members,
                               const std::vector<std::uint32_t>& own) {
        double pull = 0.0, curvature = 0.0;
        for (const std::uint32_t k : members) {
            const Motion resisted = island.bodies[k].matrix * way[k];
            pull += island.bodies[k].force.dot(way[k]) - resisted.dot(motions[k]);
            curvature += resisted.dot(way[k]);
        }
        // Task by task, so that sums do not depend on the number of threads.
        std::vector<Slope> sums((own.size() + kTouchesATask - 1) / kTouchesATask);
        return least_part([&](double part) {
            for_each_index(0, sums.size(), 1, [&](std::size_t task) {
                sums[task] = {};
                const std::size_t end = std::min((task + 1) * kTouchesATask, own.size());
                for (std::size_t k = task * kTouchesATask; k < end; ++k)
                    sums[task] += courses[own[k]].slope_at(part);
            });
            Slope sum{part * curvature - pull, curvature};
            for (const Slope& slope : sums) sum += slope;
            return sum;
        });
    };
    const auto find_parts = [&] {
        std::vector<std::vector<std::uint32_t>> members(island.bodies.size()), own(island.bodies.size());
        for (std::uint32_t k = 0; k < island.bodies.size(); ++k) members[groups.least(k)].push_back(k);
        for (const std::uint32_t k : acting) {
            const std::uint32_t body = std::min(touches[k].bodies[0], touches[k].bodies[1]);
            if (body != kNoNode) own[groups.least(body)].push_back(k);
        }
        for_each_index(0, members.size(), kBodiesATask, [&](std::size_t group) {
            if (members[group].empty() || is_new[group] == 0) return;
            const double part = find_part(members[group], own[group]);
            for (const std::uint32_t k : members[group]) parts[k] = part;
        });
    };
    for (bool any = true; any;) {
        find_parts();
        std::fill(is_new.begin(), is_new.end(), std::uint8_t(0));
        any = false;
        // Those that go side by side may meet where they make different parts.
        for (const std::uint32_t k : waiting) {
            const auto [a, b] = touches[k].bodies;
            if (courses[k].gap_after(parts[a], parts[b]) >= touches[k].reach || !unite(k)) continue;
            is_new[groups.least(a)] = 1;
            any = true;
        }
    }
    return parts;
}

}  // namespace gelatin::cpu
