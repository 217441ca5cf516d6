#include "cpu/descent/plane_landing.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <atomic>
#include <utility>

#include "cpu/contact/planes.h"
#include "cpu/descent/rigid_nodes.h"
#include "model/collision/surface_parts.h"
#include "model/contact/contact_surface.h"
#include "model/for_each_index.h"

namespace gelatin::cpu {
namespace {

// A body is stiff where a pressure wave passes through it in so many steps.
constexpr double kMostLandingSteps = 2.0;
// Newton's steps, and looks along each; until what is left of all forces would move the body by so much of
// what it has moved, squared.
constexpr int kMostLandingRounds = 24, kMostLandingLooks = 16;
constexpr double kEnoughLanding = 1e-6;
// Friction goes on by how nodes press until that changes by less than this part of it.
constexpr double kSteady = 1e-3;
// Nodes that are higher above a plane than so many times what the motion moves them do not reach it at first;
// those that landing itself turns into it do so in the next motion.
constexpr double kReaches = 2.0;
// Motions, each of which is to first order in rotations; of smaller ones one is enough.
constexpr int kMostMotions = 3;
constexpr double kSmallRotation = 1e-3;

// The part of a way at which a function is least whose slope there never falls.
template <class Slope>
double least_landing_part(const Slope& slope) {
    if (!(slope(1.0) > 0.0)) return 1.0;
    double low = 0.0, high = 1.0;
    for (int i = 0; i < kMostLandingLooks; ++i) {
        const double middle = 0.5 * (low + high);
        (slope(middle) > 0.0 ? high : low) = middle;
    }
    return low;
}

}  // namespace

// A node above a plane.
template <class Real>
struct PlaneLanding<Real>::Row {
    Motion along;                  // what of a motion lifts it
    std::array<Motion, 2> across;  // what moves it along the plane
    double height, stiffness;      // [m], [N/m]
    glm::dvec2 slip;               // since the step began [m]
    double coefficient;            // of friction
    double pressed;                // by what else acts on it [N]
    glm::dvec2 pulled;             // along the plane [N]
    double most = 0.0;             // of friction, with what presses the node [N]

    double pressing(const Motion& motion) const { return std::max(0.0, pressed - lifting(motion)); }
    double lifting(const Motion& motion) const { return stiffness * (height + along.dot(motion)); }
    glm::dvec2 along_plane(const Motion& motion) const {
        return {across[0].dot(motion), across[1].dot(motion)};
    }

    // Coulomb's, against the slip: as stiff as the node, up to the most.
    glm::dvec2 friction(const Motion& motion) const {
        const glm::dvec2 held = holding(motion);
        const double size = glm::length(held);
        return size > most ? most / size * held : held;
    }
    glm::dvec2 holding(const Motion& motion) const {
        return pulled + stiffness * (slip + along_plane(motion));
    }
    Motion force(const Motion& motion) const {
        const glm::dvec2 held = friction(motion);
        return pressing(motion) * along - held.x * across[0] - held.y * across[1];
    }
    // Of the force there, a way on.
    double work(const Motion& motion, const Motion& way) const {
        const double lifted = pressing(motion) * along.dot(way);
        return most > 0.0 ? lifted - glm::dot(friction(motion), along_plane(way)) : lifted;
    }
    // By which the force falls. Nodes that slide hold across their slip only.
    void add_stiffness(const Motion& motion, MotionMatrix& sum) const {
        if (pressing(motion) > 0.0) sum += stiffness * along * along.transpose();
        if (!(most > 0.0)) return;
        const glm::dvec2 held = holding(motion);
        const double size = glm::length(held);
        if (size <= most) {
            for (const Motion& direction : across) sum += stiffness * direction * direction.transpose();
        } else {
            const Motion aside = (across[1] * held.x - across[0] * held.y) / size;
            sum += stiffness * most / size * aside * aside.transpose();
        }
    }
};

template <class Real>
PlaneLanding<Real>::PlaneLanding(std::shared_ptr<const Model> model, std::span<const double> wave_times)
    : model_(std::move(model)),
      stiffnesses_(stiffnesses_at_rest(*model_)),
      wave_times_(wave_times),
      lands_(model_->objects.size()) {}

template <class Real>
bool PlaneLanding<Real>::begin(double step, const StepObjective<Real>& objective,
                               std::span<Vec4<Real>> positions) {
    std::atomic<bool> any = false;
    for_each_index(0, model_->body_count(), 1, [&](std::size_t k) {
        const auto o = static_cast<std::uint32_t>(k);
        const Range& nodes = model_->objects[o].nodes;
        const auto own = positions.subspan(nodes.first, nodes.count);
        const auto is_held = [](const Vec4<Real>& p) { return p.w == Real(0); };
        const bool is_stiff = wave_times_[o] < kMostLandingSteps * step;
        lands_[o] = is_stiff && std::none_of(own.begin(), own.end(), is_held) ? 1 : 0;
        if (lands_[o] == 0) return;
        if (is_inside(o, objective.step.targets)) any = true;
        land(o, objective, {}, positions);
    });
    return any;
}

// Of nodes that the motion may lead into a plane, or friction back.
template <class Real>
std::vector<typename PlaneLanding<Real>::Row> PlaneLanding<Real>::find_rows(
    std::uint32_t object, const StepObjective<Real>& objective, std::span<const Vec4<Real>> positions,
    std::span<const Vec3<Real>> forces, const glm::dvec3& origin, const Motion& motion) const {
    std::vector<Row> rows;
    const SurfaceParts& parts = model_->surface_parts;
    const Range places = surface_places(parts, model_->objects[object].faces);
    const double translation = motion.head<3>().norm(), rotation = motion.tail<3>().norm();
    for (const Collider& collider : model_->colliders) {
        if (collider.kind != 0) continue;
        const glm::dvec3 normal(collider.center);
        const glm::dvec3 u = glm::normalize(
            glm::cross(normal, std::abs(normal.x) < 0.5 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0)));
        const glm::dvec3 v = glm::cross(normal, u);
        for (std::uint32_t place = places.first; place < places.end(); ++place) {
            const std::uint32_t n = parts.nodes[place];
            const glm::dvec3 position(positions[n]), arm = position - origin;
            const double height = glm::dot(normal, position) - static_cast<double>(collider.center.w);
            const glm::dvec3 force = forces.empty() ? glm::dvec3(0.0) : glm::dvec3(forces[n]);
            const auto stiffness = static_cast<double>(stiffnesses_[n]);
            const double pressed = -glm::dot(force, normal);
            if (height > kReaches * (translation + rotation * glm::length(arm)) &&
                pressed <= stiffness * height)
                continue;
            const glm::dvec3 slip = position - glm::dvec3(objective.step.starts[n]);
            rows.push_back({along(arm, normal),
                            {along(arm, u), along(arm, v)},
                            height,
                            stiffness,
                            {glm::dot(u, slip), glm::dot(v, slip)},
                            static_cast<double>(collider.friction),
                            pressed,
                            {glm::dot(u, force), glm::dot(v, force)}});
        }
    }
    return rows;
}

// Newton's method for a convex function: with what presses, then with friction by that too.
template <class Real>
bool PlaneLanding<Real>::land(std::uint32_t object, const StepObjective<Real>& objective,
                              std::span<const Vec4<Real>> positions, std::span<const Vec3<Real>> forces,
                              const glm::dvec3& origin, Motion& motion) const {
    if (lands_[object] == 0 || !is_inside(object, positions, origin, motion)) return false;
    std::vector<Row> rows = find_rows(object, objective, positions, forces, origin, motion);
    const Range& nodes = model_->objects[object].nodes;
    const auto targets = std::span(objective.step.targets).subspan(nodes.first, nodes.count);
    const MotionMatrix inertia =
        inertia_matrix(sum_rigid_nodes(positions.subspan(nodes.first, nodes.count), targets, origin));
    const Eigen::LDLT<MotionMatrix> yielding(inertia);
    const Motion wanted = motion;
    bool has_friction = false;
    for (int round = 0; round < kMostLandingRounds; ++round) {
        const bool is_steady = has_friction && limit_friction(motion, rows);
        Motion force = inertia * (wanted - motion);
        for (const Row& row : rows) force += row.force(motion);
        const Motion made = motion - wanted;
        if (force.dot(yielding.solve(force)) <= kEnoughLanding * made.dot(inertia * made)) {
            if (is_steady) break;
            has_friction = true;
            continue;
        }
        MotionMatrix held = inertia;
        for (const Row& row : rows) row.add_stiffness(motion, held);
        const Motion way = Eigen::LDLT<MotionMatrix>(held).solve(force);
        if (!way.allFinite()) break;
        motion += least_landing_part([&](double part) {
                      const Motion there = motion + part * way;
                      double slope = way.dot(inertia * (there - wanted));
                      for (const Row& row : rows) slope -= row.work(there, way);
                      return slope;
                  }) *
                  way;
    }
    return true;
}

// By how nodes press now. @return whether that is hardly anything new
template <class Real>
bool PlaneLanding<Real>::limit_friction(const Motion& motion, std::vector<Row>& rows) {
    double sum = 0.0, change = 0.0;
    for (Row& row : rows) {
        const double most = row.coefficient * row.pressing(motion);
        sum += most;
        change += std::abs(most - row.most);
        row.most = most;
    }
    return change <= kSteady * sum;
}

template <class Real>
void PlaneLanding<Real>::land(std::uint32_t object, const StepObjective<Real>& objective,
                              std::span<const Vec3<Real>> forces, std::span<Vec4<Real>> positions) const {
    const Range& nodes = model_->objects[object].nodes;
    if (lands_[object] == 0) return;
    for (int i = 0; i < kMostMotions && is_inside(object, positions); ++i) {
        const glm::dvec3 origin(positions[nodes.first]);
        const auto targets = std::span(objective.step.targets).subspan(nodes.first, nodes.count);
        const RigidSums sums = sum_rigid_nodes(
            std::span<const Vec4<Real>>(positions.subspan(nodes.first, nodes.count)), targets, origin);
        const glm::dvec3 center = origin + sums.arm / sums.stiffness;
        Motion motion = Motion::Zero();
        land(object, objective, positions, forces, center, motion);
        move_rigid_nodes(
            {center, {motion(0), motion(1), motion(2)}, cayley_rotation({motion(3), motion(4), motion(5)})},
            positions.subspan(nodes.first, nodes.count));
        if (motion.tail<3>().norm() < kSmallRotation) break;
    }
}

// A node at r from the origin is n . s + (n x w) . r higher after a motion (s, w).
template <class Real>
bool PlaneLanding<Real>::is_inside(std::uint32_t object, std::span<const Vec4<Real>> positions,
                                   const glm::dvec3& origin, const Motion& motion) const {
    const Range& nodes = model_->objects[object].nodes;
    const glm::dvec3 translation(motion(0), motion(1), motion(2)), rotation(motion(3), motion(4), motion(5));
    return std::any_of(model_->colliders.begin(), model_->colliders.end(), [&](const Collider& collider) {
        if (collider.kind != 0) return false;
        const glm::dvec3 normal(collider.center), turned = glm::cross(normal, rotation);
        const double least = static_cast<double>(
            least_height<Real>(positions.subspan(nodes.first, nodes.count), Vec3<Real>(normal + turned)));
        const double lifted = glm::dot(normal, translation) - glm::dot(turned, origin);
        return least + lifted < static_cast<double>(collider.center.w);
    });
}

template class PlaneLanding<float>;
template class PlaneLanding<double>;

}  // namespace gelatin::cpu
