#include "cpu/descent/island_system.h"

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <numeric>
#include <utility>

#include "cpu/contact/contact_law.h"
#include "model/for_each_index.h"

namespace gelatin::cpu {
namespace {

// Conjugate gradients end when the residual is this small, or after so many steps. The first solution tells
// no more than how contacts press.
constexpr double kResidual = 1e-6, kRoughResidual = 1e-3;
constexpr int kMostSteps = 100;
// The line search ends when the slope is this small, of that at the start, or after so many looks.
constexpr double kLevel = 1e-3;
constexpr int kMostLooks = 16;
// Each thread takes at least so many at a time.
constexpr std::size_t kBodiesATask = 64, kTouchesATask = 512;

using Matrix = Eigen::Matrix3d;

Eigen::Vector3d vector(const glm::dvec3& v) {
    return {v.x, v.y, v.z};
}

Matrix cross_matrix(const Eigen::Vector3d& v) {
    Matrix m;
    m << 0.0, -v.z(), v.y(), v.z(), 0.0, -v.x(), -v.y(), v.x(), 0.0;
    return m;
}

double dot(const std::vector<Motion>& a, const std::vector<Motion>& b) {
    double sum = 0.0;
    for (std::size_t k = 0; k < a.size(); ++k) sum += a[k].dot(b[k]);
    return sum;
}

// What a force that acts at an arm is for the body.
Motion wrench(const Eigen::Vector3d& arm, const Eigen::Vector3d& force) {
    Motion m;
    m << force, arm.cross(force);
    return m;
}

// How a point at an arm moves.
glm::dvec3 displacement(const Motion& motion, const glm::dvec3& arm) {
    return glm::dvec3(motion(0), motion(1), motion(2)) +
           glm::cross(glm::dvec3(motion(3), motion(4), motion(5)), arm);
}

// Adds a stiffness between points at two arms, as what their bodies feel: J_a^T K J_b with J = (1, -[r]x).
void add_stiffness(const Matrix& stiffness, const Matrix& arm_a, const Matrix& arm_b, double sign,
                   MotionMatrix& sum) {
    const Matrix turned = -sign * stiffness * arm_b;
    sum.topLeftCorner<3, 3>() += sign * stiffness;
    sum.topRightCorner<3, 3>() += turned;
    sum.bottomLeftCorner<3, 3>() += sign * arm_a * stiffness;
    sum.bottomRightCorner<3, 3>() += arm_a * turned;
}

// Friction to second order.
struct Friction {
    double share;  // of what would hold if nothing slid
    double left;   // of its stiffness along the slip
};

// Along a slip the force does not change with it. After a solution, it is that of the least quadratic
// energy which is friction's where that led, and above it elsewhere. So another one does not lead past the
// end of a slip.
Friction friction_of(const IslandSystem::Touch& touch) {
    const double length = glm::length(touch.hold + touch.stiffness * touch.slip);
    const bool slides = length > touch.limit, is_first = touch.slip == glm::dvec3(0.0);
    return {slides ? touch.limit / length : 1.0, slides && is_first ? kSlipShare<double> : 1.0};
}

// What a contact adds to second order.
struct Terms {
    Matrix stiffness = Matrix::Zero();                // against the displacement of one side by the other
    Eigen::Vector3d force = Eigen::Vector3d::Zero();  // on the second side [N]
};

Terms terms_of(const IslandSystem::Touch& touch) {
    Terms terms;
    const Eigen::Vector3d normal = vector(touch.normal);
    const double pressing = contact_force(touch.gap, touch.reach, touch.stiffness);
    if (pressing > 0.0) {
        terms.force = pressing * normal;
        terms.stiffness =
            contact_hessian(touch.gap, touch.reach, touch.stiffness) * normal * normal.transpose();
    }
    if (!(touch.limit > 0.0)) return terms;
    const Eigen::Vector3d hold = vector(touch.hold);
    const Friction friction = friction_of(touch);
    const double stiffness = friction.share * touch.stiffness;
    terms.force -= friction.share * hold;
    terms.stiffness += stiffness * (Matrix::Identity() - normal * normal.transpose());
    if (friction.left < 1.0)
        terms.stiffness -= (1.0 - friction.left) * stiffness / hold.squaredNorm() * hold * hold.transpose();
    return terms;
}

// Of an energy, by the part that is made of a motion.
struct Slope {
    double value, change;  // [J]
};

// A contact on the way of its bodies.
class Course {
public:
    Course() = default;
    // @param slip of the second side beside the first [m]
    Course(const IslandSystem::Touch& touch, const Friction& friction, const glm::dvec3& slip)
        : touch_(&touch),
          friction_(friction),
          held_squared_(glm::dot(touch.hold, touch.hold)),
          held_along_(glm::dot(touch.hold, slip)),
          slip_squared_(glm::dot(slip, slip)) {}

    bool acts() const {
        return std::min(touch_->gap, touch_->gap + touch_->change) < touch_->reach || touch_->limit > 0.0;
    }

    Slope slope_at(double part) const {
        Slope slope = pressing_at(part);
        if (!(touch_->limit > 0.0)) return slope;
        const double way = part * touch_->stiffness;  // of what would hold, by the slip
        const double along = held_along_ + way * slip_squared_;
        const double squared = held_squared_ + way * (held_along_ + along);
        const bool slides = squared > touch_->limit * touch_->limit;
        const double share = slides ? touch_->limit / std::sqrt(squared) : 1.0;
        const double turning = slip_squared_ - (slides ? along * along / squared : 0.0);
        return {slope.value + share * along, slope.change + share * touch_->stiffness * turning};
    }

    // As it is assembled, where nothing has moved.
    Slope second_order() const {
        Slope slope = touch_->gap < touch_->reach ? pressing_at(0.0) : Slope{0.0, 0.0};
        if (!(touch_->limit > 0.0)) return slope;
        double across = slip_squared_;
        if (friction_.left < 1.0)
            across -= (1.0 - friction_.left) * held_along_ * held_along_ / held_squared_;
        return {slope.value + friction_.share * held_along_,
                slope.change + friction_.share * touch_->stiffness * across};
    }

private:
    Slope pressing_at(double part) const {
        const double gap = touch_->gap + part * touch_->change;
        return {-contact_force(gap, touch_->reach, touch_->stiffness) * touch_->change,
                contact_hessian(gap, touch_->reach, touch_->stiffness) * touch_->change * touch_->change};
    }

    const IslandSystem::Touch* touch_ = nullptr;
    Friction friction_{1.0, 1.0};
    double held_squared_ = 0.0, held_along_ = 0.0, slip_squared_ = 0.0;
};

}  // namespace

// Friction depends on how contacts press, of which sweeps find far too much in stiff bodies: it is taken by
// what a first solution leaves of that.
std::vector<Motion> IslandSystem::find_motions(const Land& land) {
    find_couplings();
    Motions newton(bodies.size(), Motion::Zero());
    const auto holds = [](const Touch& touch) { return touch.friction > 0.0; };
    if (std::any_of(touches.begin(), touches.end(), holds)) {
        assemble();
        solve(kRoughResidual, newton);
        shortened(newton);
    }
    assemble();
    solve(kResidual, newton);
    if (land) {
        std::vector<std::uint8_t> lands(bodies.size());
        for_each_index(0, bodies.size(), 1, [&](std::size_t k) { lands[k] = land(k, newton[k]) ? 1 : 0; });
        has_landed_ = std::any_of(lands.begin(), lands.end(), [](std::uint8_t l) { return l != 0; });
    }
    return shortened(newton);
}

void IslandSystem::find_couplings() {
    couplings_.clear();
    for (std::uint32_t k = 0; k < touches.size(); ++k) {
        if (couplings_.empty() || couplings_.back().bodies != touches[k].bodies) {
            Coupling& coupling = couplings_.emplace_back();
            coupling.bodies = touches[k].bodies;
            coupling.touches.first = k;
        }
        ++couplings_.back().touches.count;
    }
    const auto for_sides = [&](const auto& use) {
        for (std::uint32_t k = 0; k < couplings_.size(); ++k)
            for (std::size_t side = 0; side < 2; ++side)
                if (couplings_[k].bodies[side] != kNoNode) use(couplings_[k].bodies[side], Use{k, side});
    };
    use_starts_.assign(bodies.size() + 1, 0);
    for_sides([&](std::uint32_t body, const Use&) { ++use_starts_[body + 1]; });
    std::partial_sum(use_starts_.begin(), use_starts_.end(), use_starts_.begin());
    uses_.resize(use_starts_.back());
    std::vector<std::uint32_t> next(use_starts_.begin(), use_starts_.end() - 1);
    for_sides([&](std::uint32_t body, const Use& use) { uses_[next[body]++] = use; });
}

void IslandSystem::sum_touches(Coupling& coupling) const {
    for (std::size_t side = 0; side < 2; ++side) {
        coupling.own[side].setZero();
        coupling.forces[side].setZero();
    }
    coupling.across.setZero();
    for (std::uint32_t k = coupling.touches.first; k < coupling.touches.end(); ++k) {
        const Terms terms = terms_of(touches[k]);
        if (terms.stiffness.isZero(0.0)) continue;
        const std::array<Eigen::Vector3d, 2> arms{vector(touches[k].arms[0]), vector(touches[k].arms[1])};
        const std::array<Matrix, 2> turns{cross_matrix(arms[0]), cross_matrix(arms[1])};
        for (std::size_t side = 0; side < 2; ++side) {
            if (coupling.bodies[side] == kNoNode) continue;
            add_stiffness(terms.stiffness, turns[side], turns[side], 1.0, coupling.own[side]);
            coupling.forces[side] += (side == 0 ? -1.0 : 1.0) * wrench(arms[side], terms.force);
        }
        if (coupling.bodies[0] != kNoNode && coupling.bodies[1] != kNoNode)
            add_stiffness(terms.stiffness, turns[0], turns[1], -1.0, coupling.across);
    }
}

void IslandSystem::assemble() {
    for_each_index(0, touches.size(), kTouchesATask, [&](std::size_t k) {
        Touch& touch = touches[k];
        touch.limit = touch.friction * contact_force(touch.gap + touch.change, touch.reach, touch.stiffness);
    });
    for_each_index(0, couplings_.size(), 4, [&](std::size_t k) { sum_touches(couplings_[k]); });
    const std::size_t count = bodies.size();
    matrices_.resize(count);
    inverses_.resize(count);
    forces_.resize(count);
    for_each_index(0, count, kBodiesATask, [&](std::size_t k) {
        matrices_[k] = bodies[k].matrix;
        forces_[k] = bodies[k].force;
        for (const auto& [coupling, side] : uses_of(k)) {
            matrices_[k] += couplings_[coupling].own[side];
            forces_[k] += couplings_[coupling].forces[side];
        }
        inverses_[k] = Eigen::LLT<MotionMatrix>(matrices_[k]).solve(MotionMatrix::Identity());
    });
}

// By conjugate gradients, preconditioned with the bodies' own blocks. @param motions where they start
void IslandSystem::solve(double residual, Motions& motions) const {
    const std::size_t count = bodies.size();
    const auto precondition = [&](const Motions& r, Motions& z) {
        for_each_index(0, count, kBodiesATask, [&](std::size_t k) { z[k].noalias() = inverses_[k] * r[k]; });
        return dot(r, z);
    };
    Motions left = forces_, pulled(count);
    const double enough = residual * residual * precondition(left, pulled);
    const Motions held = product(motions);
    for (std::size_t k = 0; k < count; ++k) left[k] -= held[k];
    double now = precondition(left, pulled);
    Motions direction = pulled;
    for (int i = 0; i < kMostSteps && now > enough; ++i) {
        const Motions resisted = product(direction);
        const double curvature = dot(direction, resisted);
        if (!(curvature > 0.0)) break;
        const double length = now / curvature;
        for (std::size_t k = 0; k < count; ++k) {
            motions[k] += length * direction[k];
            left[k] -= length * resisted[k];
        }
        const double before = std::exchange(now, precondition(left, pulled));
        for (std::size_t k = 0; k < count; ++k) direction[k] = pulled[k] + now / before * direction[k];
    }
}

// Contacts cancel in the sum of all forces, so that momentum does not depend on how well the rest was solved.
// Tells each contact how its gap changes.
std::vector<Motion> IslandSystem::shortened(const Motions& newton) {
    Motions motions = newton;
    Motion common = common_motion(motions);
    for (Motion& motion : motions) motion -= common;
    const bool is_free = !is_held && !is_outside_touched && !has_landed_;
    if (is_free) common = free_translation();
    const double part = least_along(motions, common);
    for (Touch& touch : touches) {
        touch.change *= part;
        touch.slip *= part;
    }
    for (Motion& motion : motions) motion = part * motion + common;
    return motions;
}

// What all bodies do before the rest is shortened. Where colliders hold them, no more of it than lowers the
// objective by itself: what they yield to it with by rotating is part of the rest. Where one lands, none:
// only parts of the whole motion end outside of planes.
Motion IslandSystem::common_motion(const Motions& motions) const {
    if (is_held || has_landed_) return Motion::Zero();
    Motion common = mean_translation(motions);
    if (is_outside_touched) {
        const Motions all(motions.size(), common);
        const double resisted = dot(all, product(all));
        common *= resisted > 0.0 ? std::clamp(dot(forces_, all) / resisted, 0.0, 1.0) : 0.0;
    }
    return common;
}

// By mass; it changes no gap.
Motion IslandSystem::mean_translation(const Motions& motions) const {
    Motion sum = Motion::Zero();
    double stiffness = 0.0;
    for (std::size_t k = 0; k < bodies.size(); ++k) {
        sum.head<3>() += bodies[k].stiffness * motions[k].head<3>();
        stiffness += bodies[k].stiffness;
    }
    return sum / stiffness;
}

// What brings all of them to their targets on average.
Motion IslandSystem::free_translation() const {
    Motion sum = Motion::Zero();
    double stiffness = 0.0;
    for (std::size_t k = 0; k < bodies.size(); ++k) {
        sum.head<3>() += forces_[k].head<3>();
        stiffness += bodies[k].stiffness;
    }
    return sum / stiffness;
}

// The part of the motions, after the common one, at which the objective is least: contacts and friction as
// they are, the rest to second order. Newton's step alone would throw bodies through the reach of others, and
// friction would move them farther than what they lie on.
double IslandSystem::least_along(const Motions& motions, const Motion& common) {
    const Motions resisted = product(motions);
    double pull = 0.0, curvature = dot(motions, resisted);
    for (std::size_t k = 0; k < bodies.size(); ++k)
        pull += forces_[k].dot(motions[k]) - common.dot(resisted[k]);
    std::vector<Course> courses(touches.size());
    for_each_index(0, touches.size(), kTouchesATask, [&](std::size_t k) {
        Touch& touch = touches[k];
        glm::dvec3 apart(0.0);
        for (std::size_t side = 0; side < 2; ++side) {
            if (touch.bodies[side] == kNoNode) continue;
            const glm::dvec3 way = displacement(motions[touch.bodies[side]], touch.arms[side]);
            apart += side == 0 ? -way : way;
        }
        const Friction friction = friction_of(touch);
        touch.change = glm::dot(apart, touch.normal);
        touch.slip = apart - touch.change * touch.normal;
        courses[k] = Course(touch, friction, touch.slip);
    });
    std::erase_if(courses, [](const Course& course) { return !course.acts(); });
    for (const Course& course : courses) {
        const Slope second_order = course.second_order();
        pull += second_order.value;
        curvature -= second_order.change;
    }
    const auto slope_at = [&](double part) {
        Slope slope{part * curvature - pull, curvature};
        for (const Course& course : courses) {
            const Slope own = course.slope_at(part);
            slope.value += own.value;
            slope.change += own.change;
        }
        return slope;
    };
    const double enough = kLevel * std::abs(slope_at(0.0).value);
    double low = 0.0, high = 1.0, part = 1.0, last = std::numeric_limits<double>::infinity();
    for (int i = 0; i < kMostLooks; ++i) {
        const Slope slope = slope_at(part);
        const double steepness = std::abs(slope.value);
        if (steepness <= enough || (part == 1.0 && !(slope.value > 0.0))) return part;
        (slope.value > 0.0 ? high : low) = part;
        part -= slope.value / slope.change;
        // Deep within reach, where forces rise without bound, Newton's steps are short.
        if (!(part > low && part < high) || steepness > 0.5 * last) part = 0.5 * (low + high);
        last = steepness;
    }
    return low;
}

std::vector<Motion> IslandSystem::product(const Motions& motions) const {
    Motions q(motions.size());
    for_each_index(0, bodies.size(), kBodiesATask, [&](std::size_t k) {
        q[k].noalias() = matrices_[k] * motions[k];
        for (const auto& [index, side] : uses_of(k)) {
            const Coupling& coupling = couplings_[index];
            const std::uint32_t other = coupling.bodies[1 - side];
            if (other == kNoNode) continue;
            if (side == 0) {
                q[k].noalias() += coupling.across * motions[other];
            } else {
                q[k].noalias() += coupling.across.transpose() * motions[other];
            }
        }
    });
    return q;
}

}  // namespace gelatin::cpu
