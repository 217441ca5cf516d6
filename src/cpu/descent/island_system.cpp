#include "cpu/descent/island_system.h"

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numeric>
#include <utility>

#include "cpu/contact/contact_law.h"
#include "cpu/descent/island_search.h"
#include "model/for_each_index.h"

namespace gelatin::cpu {
namespace {

// Newton's steps end when what is left to gain is this small a part of what was gained, or after so many.
constexpr double kEnough = 1e-4;
constexpr int kMostSystemRounds = 8;
// From this part of the gap at the start on, of no more than the reach, forces grow linearly. With the
// barrier, which nothing needs here, crowds would keep less of their motion.
constexpr double kStraight = 0.5;
// Farther than so many times their reach contacts do not know what bodies meet.
constexpr double kFar = 16.0;
// What is held carries bodies along no farther than this part of a gap.
constexpr double kMostClosed = 0.9;
// Conjugate gradients end when the residual is this small, of that at the start of the round, and of the
// first round, or after so many steps.
constexpr double kResidual = 1e-3, kLeastResidual = 1e-6;
constexpr int kMostSteps = 100;
// Each thread takes at least so many at a time.
constexpr std::size_t kSystemBodiesATask = 64, kSystemTouchesATask = 512;

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

// Adds a stiffness between points at two arms, as what their bodies feel: J_a^T K J_b with J = (1, -[r]x).
void add_stiffness(const Matrix& stiffness, const Matrix& arm_a, const Matrix& arm_b, double sign,
                   MotionMatrix& sum) {
    const Matrix turned = -sign * stiffness * arm_b;
    sum.topLeftCorner<3, 3>() += sign * stiffness;
    sum.topRightCorner<3, 3>() += turned;
    sum.bottomLeftCorner<3, 3>() += sign * arm_a * stiffness;
    sum.bottomRightCorner<3, 3>() += arm_a * turned;
}

// What a contact adds to second order.
struct Terms {
    Matrix stiffness = Matrix::Zero();                // against the displacement of one side by the other
    Eigen::Vector3d force = Eigen::Vector3d::Zero();  // on the second side [N]
};

// Along a slip the force of friction does not change with it.
Terms terms_of(const IslandSystem::Touch& touch) {
    Terms terms;
    if (touch.gap >= touch.reach) return terms;
    const Eigen::Vector3d normal = vector(touch.normal);
    terms.force = touch.force_at(touch.gap) * normal;
    terms.stiffness = touch.hessian_at(touch.gap) * normal * normal.transpose();
    if (!(touch.limit > 0.0)) return terms;
    const Eigen::Vector3d hold = vector(touch.hold);
    const double length = hold.norm(), share = std::min(1.0, touch.limit / length);
    terms.force -= share * hold;
    Matrix across = Matrix::Identity() - normal * normal.transpose();
    if (length > touch.limit) across -= hold * hold.transpose() / hold.squaredNorm();
    terms.stiffness += share * touch.stiffness * across;
    return terms;
}

}  // namespace

double IslandSystem::Touch::force_at(double gap_there) const {
    const double inside = std::max(gap_there, least);
    return contact_force(inside, reach, stiffness) +
           contact_hessian(inside, reach, stiffness) * (inside - gap_there);
}

double IslandSystem::Touch::hessian_at(double gap_there) const {
    return contact_hessian(std::max(gap_there, least), reach, stiffness);
}

// Newton's method, with the friction that what presses then allows: sweeps find far too much of both in stiff
// bodies. In the sum of all forces contacts cancel, so that momentum does not depend on how well the rest was
// solved.
std::vector<Motion> IslandSystem::find_motions(const Land& land) {
    find_couplings();
    const bool is_free = !is_held && !is_outside_touched;
    const Motion common = is_free ? free_translation() : Motion::Zero();
    motions_.assign(bodies.size(), common);
    for (Touch& touch : touches) touch.least = kStraight * std::min(touch.gap, touch.reach);
    double gained = 0.0, least_residual = 0.0;
    for (int round = 0; round < kMostSystemRounds; ++round) {
        assemble();
        const Motions whole = newton_step(least_residual);
        Motions way = whole;
        shorten(way, is_carried() ? carried_along(way) : least_parts(*this, motions_, way));
        const double gain = dot(forces_, whole), made = dot(forces_, way);
        move(way);
        if (!(made > 0.0) || gain <= kEnough * gained || leads_far(whole)) break;
        gained += made;
    }
    if (is_free) {
        const Motion off = common - mean_translation(motions_);
        for (Motion& motion : motions_) motion += off;
    }
    return land ? landed(land) : motions_;
}

// Whether bodies that are stopped would go much farther into each other than contacts reach. Then the planes
// of contacts tell nothing of where more of Newton's steps would lead: round the other body.
bool IslandSystem::leads_far(const Motions& way) const {
    return std::any_of(touches.begin(), touches.end(), [&](const Touch& touch) {
        return touch.gap < touch.reach && glm::dot(apart(touch, way), touch.normal) < -kFar * touch.reach;
    });
}

// Where a body lands, those that press each other on the whole motion make only a part of it.
std::vector<Motion> IslandSystem::landed(const Land& land) {
    Motions wanted = motions_;
    std::vector<std::uint8_t> lands(bodies.size());
    for_each_index(0, bodies.size(), 1, [&](std::size_t k) { lands[k] = land(k, wanted[k]) ? 1 : 0; });
    if (std::none_of(lands.begin(), lands.end(), [](std::uint8_t l) { return l != 0; })) return motions_;
    Motions back = motions_;
    for (Motion& motion : back) motion = -motion;
    move(back);
    shorten(wanted, least_parts(*this, motions_, wanted));
    move(wanted);
    return motions_;
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
    std::vector<Range> ranges;
    for (const Coupling& coupling : couplings_) ranges.push_back(coupling.touches);
    pieces_ = ObjectPieces(ranges);
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

void IslandSystem::Sums::add(const Sums& other) {
    for (std::size_t side = 0; side < 2; ++side) {
        own[side] += other.own[side];
        forces[side] += other.forces[side];
    }
    across += other.across;
}

IslandSystem::Sums IslandSystem::sum_touches(const Coupling& coupling, const Range& of) const {
    Sums sums;
    for (std::uint32_t k = of.first; k < of.end(); ++k) {
        Terms terms = terms_of(touches[k]);
        if (terms.stiffness.isZero(0.0)) continue;
        terms.force -= terms.stiffness * vector(touches[k].carried);
        const std::array<Eigen::Vector3d, 2> arms{vector(touches[k].arms[0]), vector(touches[k].arms[1])};
        const std::array<Matrix, 2> turns{cross_matrix(arms[0]), cross_matrix(arms[1])};
        for (std::size_t side = 0; side < 2; ++side) {
            if (coupling.bodies[side] == kNoNode) continue;
            add_stiffness(terms.stiffness, turns[side], turns[side], 1.0, sums.own[side]);
            sums.forces[side] += (side == 0 ? -1.0 : 1.0) * wrench(arms[side], terms.force);
        }
        if (coupling.bodies[0] != kNoNode && coupling.bodies[1] != kNoNode)
            add_stiffness(terms.stiffness, turns[0], turns[1], -1.0, sums.across);
    }
    return sums;
}

void IslandSystem::assemble() {
    for_each_index(0, touches.size(), kSystemTouchesATask, [&](std::size_t k) {
        Touch& touch = touches[k];
        touch.limit = touch.friction * touch.force_at(touch.gap);
    });
    sums_.assign(couplings_.size(), Sums());
    pieces_.gather<Sums>(
        sums_,
        [&](const ObjectPieces::Piece& piece) { return sum_touches(couplings_[piece.object], piece.range); },
        [](Sums& sums, const Sums& more) { sums.add(more); });
    const std::size_t count = bodies.size();
    matrices_.resize(count);
    inverses_.resize(count);
    forces_.resize(count);
    for_each_index(0, count, kSystemBodiesATask, [&](std::size_t k) {
        matrices_[k] = bodies[k].matrix;
        forces_[k] = bodies[k].force - bodies[k].matrix * motions_[k];
        for (const auto& [coupling, side] : uses_of(k)) {
            matrices_[k] += sums_[coupling].own[side];
            forces_[k] += sums_[coupling].forces[side];
        }
        inverses_[k] = Eigen::LLT<MotionMatrix>(matrices_[k]).solve(MotionMatrix::Identity());
    });
}

// By conjugate gradients, preconditioned with the bodies' own blocks.
// @param least_residual input: of this solution, 0 in the first round; output: of those to come
IslandSystem::Motions IslandSystem::newton_step(double& least_residual) const {
    const std::size_t count = bodies.size();
    const auto precondition = [&](const Motions& r, Motions& z) {
        for_each_index(0, count, kSystemBodiesATask,
                       [&](std::size_t k) { z[k].noalias() = inverses_[k] * r[k]; });
        return dot(r, z);
    };
    Motions motions(count, Motion::Zero()), left = forces_, pulled(count);
    double now = precondition(left, pulled);
    if (least_residual == 0.0) least_residual = kLeastResidual * kLeastResidual * now;
    const double enough = std::max(kResidual * kResidual * now, least_residual);
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
    return motions;
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
        sum.head<3>() += bodies[k].force.head<3>();
        stiffness += bodies[k].stiffness;
    }
    return sum / stiffness;
}

glm::dvec3 IslandSystem::apart(const Touch& touch, const Motions& way) {
    glm::dvec3 sum = touch.carried;
    for (std::size_t side = 0; side < 2; ++side) {
        if (touch.bodies[side] == kNoNode) continue;
        const glm::dvec3 own = touch.displacement(side, way[touch.bodies[side]]);
        sum += side == 0 ? -own : own;
    }
    return sum;
}

// @param parts by body
void IslandSystem::shorten(Motions& way, const std::vector<double>& parts) {
    for (std::size_t k = 0; k < way.size(); ++k) way[k] *= parts[k];
}

// Contacts know how wide they are then, and what holds them.
void IslandSystem::move(const Motions& way) {
    for (std::size_t k = 0; k < bodies.size(); ++k) motions_[k] += way[k];
    for_each_index(0, touches.size(), kSystemTouchesATask, [&](std::size_t k) {
        Touch& touch = touches[k];
        const glm::dvec3 moved = apart(touch, way);
        const double change = glm::dot(moved, touch.normal);
        touch.gap += change;
        touch.hold += touch.stiffness * (moved - change * touch.normal);
        touch.carried = glm::dvec3(0.0);
    });
}

bool IslandSystem::is_carried() const {
    return std::any_of(touches.begin(), touches.end(),
                       [](const Touch& touch) { return touch.carried != glm::dvec3(0.0); });
}

// The part of a way that leaves all gaps open. What is held makes no more of its own, either. It does work:
// the objective does not tell how far it goes.
std::vector<double> IslandSystem::carried_along(const Motions& way) {
    double part = 1.0;
    for (const Touch& touch : touches) {
        const double change = glm::dot(apart(touch, way), touch.normal);
        const double most = kMostClosed * std::max(0.0, touch.gap);
        if (change < -most) part = std::min(part, most / -change);
    }
    for (Touch& touch : touches) touch.carried *= part;
    return std::vector<double>(bodies.size(), part);
}

std::vector<Motion> IslandSystem::product(const Motions& motions) const {
    Motions q(motions.size());
    for_each_index(0, bodies.size(), kSystemBodiesATask, [&](std::size_t k) {
        q[k].noalias() = matrices_[k] * motions[k];
        for (const auto& [index, side] : uses_of(k)) {
            const std::uint32_t other = couplings_[index].bodies[1 - side];
            if (other == kNoNode) continue;
            if (side == 0) {
                q[k].noalias() += sums_[index].across * motions[other];
            } else {
                q[k].noalias() += sums_[index].across.transpose() * motions[other];
            }
        }
    });
    return q;
}

}  // namespace gelatin::cpu
