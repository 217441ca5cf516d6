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

    // Whether it presses or holds on the way if both bodies make the same part.
    bool acts() const {
        return std::min(touch_->gap, touch_->gap + change_) < touch_->reach || touch_->limit > 0.0;
    }
    // Whether it would if they made different parts.
    bool may_act() const {
        return is_between_ &&
               touch_->gap + std::min(sides_[1], 0.0) - std::max(sides_[0], 0.0) < touch_->reach;
    }
    // Of the energy by the part that one side makes, if the other one stops at a part of its own.
    Slope slope_beside(std::size_t side, double part, double part_of_other) const {
        if (part <= part_of_other) return {};
        const double change = side == 0 ? -sides_[0] : sides_[1];
        const double of_other = side == 0 ? sides_[1] : -sides_[0];
        const double gap = touch_->gap + part * change + part_of_other * of_other;
        return {-touch_->force_at(gap) * change, touch_->hessian_at(gap) * change * change};
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

// For each body the part of a way that its group makes.
class GroupSearch {
public:
    GroupSearch(const IslandSystem& island, std::span<const Motion> motions, const std::vector<Motion>& way);
    // By body.
    std::vector<double> parts();

private:
    // What comes to act only if its bodies make different parts, as one of them sees it.
    struct Beside {
        std::uint32_t course;
        std::size_t side;
        std::uint32_t group;  // of the other side
    };
    // Bodies that make the same part.
    struct Group {
        std::vector<std::uint32_t> bodies;
        std::vector<std::uint32_t> courses;  // of the contacts that act on its way
        std::vector<Beside> beside;
        double pull = 0.0, curvature = 0.0;  // of all but contacts [J]
        double part = 1.0, next_part = 1.0;
        bool has_stopped = false;  // in the last round
    };

    void find_part(Group& group) const;
    bool meets_more(const Group& group) const;

    std::vector<Course> courses_;
    std::vector<Group> groups_;
    std::vector<std::uint32_t> numbers_;  // of groups, by body
};

GroupSearch::GroupSearch(const IslandSystem& island, std::span<const Motion> motions,
                         const std::vector<Motion>& way)
    : courses_(island.touches.size()), numbers_(island.bodies.size()) {
    for_each_index(0, courses_.size(), kTouchesATask,
                   [&](std::size_t k) { courses_[k] = Course(island.touches[k], way); });
    DisjointSets sets(numbers_.size());
    std::vector<std::uint32_t> acting, waiting;
    for (std::uint32_t k = 0; k < courses_.size(); ++k) {
        const auto [a, b] = island.touches[k].bodies;
        if (courses_[k].acts()) {
            acting.push_back(k);
            if (a != kNoNode && b != kNoNode) sets.unite(a, b);
        } else if (courses_[k].may_act()) {
            waiting.push_back(k);
        }
    }
    for (std::uint32_t body = 0; body < numbers_.size(); ++body) {
        const std::uint32_t first = sets.least(body);
        if (first == body) {
            numbers_[body] = static_cast<std::uint32_t>(groups_.size());
            groups_.emplace_back();
        }
        numbers_[body] = numbers_[first];
        groups_[numbers_[body]].bodies.push_back(body);
    }
    for (const std::uint32_t k : acting) {
        const std::uint32_t body = std::min(island.touches[k].bodies[0], island.touches[k].bodies[1]);
        if (body != kNoNode) groups_[numbers_[body]].courses.push_back(k);
    }
    for (const std::uint32_t k : waiting) {
        const auto [a, b] = island.touches[k].bodies;
        if (numbers_[a] == numbers_[b]) continue;
        groups_[numbers_[a]].beside.push_back({k, 0, numbers_[b]});
        groups_[numbers_[b]].beside.push_back({k, 1, numbers_[a]});
    }
    for_each_index(0, groups_.size(), kBodiesATask, [&](std::size_t g) {
        for (const std::uint32_t body : groups_[g].bodies) {
            const Motion resisted = island.bodies[body].matrix * way[body];
            groups_[g].pull += island.bodies[body].force.dot(way[body]) - resisted.dot(motions[body]);
            groups_[g].curvature += resisted.dot(way[body]);
        }
    });
}

// First nothing has stopped. Then those stop that meet what has: parts become less from round to round.
std::vector<double> GroupSearch::parts() {
    const auto find_parts = [&](const auto& is_one) {
        for_each_index(0, groups_.size(), kBodiesATask, [&](std::size_t g) {
            if (is_one(groups_[g])) find_part(groups_[g]);
        });
        bool any = false;
        for (Group& group : groups_) {
            group.has_stopped = group.next_part < group.part;
            group.part = group.next_part;
            any |= group.has_stopped;
        }
        return any;
    };
    bool any = find_parts([](const Group&) { return true; });
    while (any) any = find_parts([&](const Group& group) { return meets_more(group); });
    std::vector<double> parts(numbers_.size());
    for (std::size_t body = 0; body < parts.size(); ++body) parts[body] = groups_[numbers_[body]].part;
    return parts;
}

// Something that has stopped in the last round is in the way.
bool GroupSearch::meets_more(const Group& group) const {
    return std::any_of(group.beside.begin(), group.beside.end(), [&](const Beside& beside) {
        const Group& other = groups_[beside.group];
        return other.has_stopped &&
               courses_[beside.course].slope_beside(beside.side, group.part, other.part).change > 0.0;
    });
}

void GroupSearch::find_part(Group& group) const {
    // Task by task, so that sums do not depend on the number of threads.
    std::vector<Slope> sums((group.courses.size() + kTouchesATask - 1) / kTouchesATask);
    const double part = least_part([&](double at) {
        for_each_index(0, sums.size(), 1, [&](std::size_t task) {
            sums[task] = {};
            const std::size_t end = std::min((task + 1) * kTouchesATask, group.courses.size());
            for (std::size_t k = task * kTouchesATask; k < end; ++k)
                sums[task] += courses_[group.courses[k]].slope_at(at);
        });
        Slope sum{at * group.curvature - group.pull, group.curvature};
        for (const Slope& slope : sums) sum += slope;
        for (const Beside& beside : group.beside)
            sum += courses_[beside.course].slope_beside(beside.side, at, groups_[beside.group].part);
        return sum;
    });
    group.next_part = std::min(group.part, part);
}

}  // namespace

// Newton's step alone would throw bodies through the reach of others, and friction would move them farther
// than what they lie on. In a crowd the first to meet would stop all, if all made the same part.
std::vector<double> least_parts(const IslandSystem& island, std::span<const Motion> motions,
                                const std::vector<Motion>& way) {
    return GroupSearch(island, motions, way).parts();
}

}  // namespace gelatin::cpu
