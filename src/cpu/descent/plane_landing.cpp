#include "cpu/descent/plane_landing.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <atomic>
#include <utility>

#include "cpu/contact/planes.h"
#include "cpu/descent/rigid_nodes.h"
#include "cpu/descent/wave_times.h"
#include "model/contact/contact_surface.h"
#include "model/for_each_index.h"

namespace gelatin::cpu {
namespace {

// A body is stiff where a pressure wave passes through it in so many steps.
constexpr double kMostSteps = 2.0;
// Newton's steps, and looks along each.
constexpr int kMostRounds = 8, kMostLooks = 12;
// Motions, each of which is to first order in rotations.
constexpr int kMostMotions = 3;

// The part of a way at which a function is least whose slope there never falls.
template <class Slope>
double least_part(const Slope& slope) {
    if (!(slope(1.0) > 0.0)) return 1.0;
    double low = 0.0, high = 1.0;
    for (int i = 0; i < kMostLooks; ++i) {
        const double middle = 0.5 * (low + high);
        (slope(middle) > 0.0 ? high : low) = middle;
    }
    return low;
}

}  // namespace

// A node above a plane.
template <class Real>
struct PlaneLanding<Real>::Row {
    Motion along;              // what of a motion lifts it
    double height, stiffness;  // [m], [N/m]

    double height_after(const Motion& motion) const { return height + along.dot(motion); }
};

template <class Real>
PlaneLanding<Real>::PlaneLanding(std::shared_ptr<const Model> model)
    : model_(std::move(model)),
      stiffnesses_(stiffnesses_at_rest(*model_)),
      wave_times_(wave_times(*model_)),
      lands_(model_->objects.size()) {}

template <class Real>
bool PlaneLanding<Real>::begin(double step, const StepObjective<Real>& objective,
                               std::span<Vec4<Real>> positions) {
    std::atomic<bool> any = false;
    for_each_index(0, wave_times_.size(), 1, [&](std::size_t k) {
        const auto o = static_cast<std::uint32_t>(k);
        const Range& nodes = model_->objects[o].nodes;
        const auto own = positions.subspan(nodes.first, nodes.count);
        const auto is_held = [](const Vec4<Real>& p) { return p.w == Real(0); };
        const bool is_stiff = wave_times_[o] < kMostSteps * step;
        lands_[o] = is_stiff && std::none_of(own.begin(), own.end(), is_held) ? 1 : 0;
        if (lands_[o] == 0 || !is_inside(o, positions)) return;
        any = true;
        land(o, objective, positions);
    });
    return any;
}

template <class Real>
std::vector<typename PlaneLanding<Real>::Row> PlaneLanding<Real>::find_rows(
    std::uint32_t object, std::span<const Vec4<Real>> positions, const glm::dvec3& origin) const {
    std::vector<Row> rows;
    const SurfaceParts& parts = model_->surface_parts;
    const Range& faces = model_->objects[object].faces;
    const std::uint32_t first = parts.face_starts[faces.first].x, end = parts.face_starts[faces.end()].x;
    for (const Collider& collider : model_->colliders) {
        if (collider.kind != 0) continue;
        const glm::dvec3 normal(collider.center);
        for (std::uint32_t place = first; place < end; ++place) {
            const std::uint32_t n = parts.nodes[place];
            const glm::dvec3 position(positions[n]);
            rows.push_back({along(position - origin, normal),
                            glm::dot(normal, position) - static_cast<double>(collider.center.w),
                            static_cast<double>(stiffnesses_[n])});
        }
    }
    return rows;
}

// Newton's method for a convex function: of nodes that press, until it is the same ones.
template <class Real>
bool PlaneLanding<Real>::land(std::uint32_t object, const StepObjective<Real>& objective,
                              std::span<const Vec4<Real>> positions, const glm::dvec3& origin,
                              Motion& motion) const {
    if (lands_[object] == 0 || !is_inside(object, positions, origin, motion)) return false;
    const std::vector<Row> rows = find_rows(object, positions, origin);
    const auto find_pressing = [&] {
        std::vector<std::size_t> pressing;
        for (std::size_t k = 0; k < rows.size(); ++k)
            if (rows[k].height_after(motion) < 0.0) pressing.push_back(k);
        return pressing;
    };
    std::vector<std::size_t> pressing = find_pressing();
    const Range& nodes = model_->objects[object].nodes;
    const auto targets = std::span(objective.step.targets).subspan(nodes.first, nodes.count);
    const MotionMatrix inertia =
        inertia_matrix(sum_rigid_nodes(positions.subspan(nodes.first, nodes.count), targets, origin));
    const Motion wanted = motion;
    for (int round = 0; round < kMostRounds; ++round) {
        MotionMatrix held = inertia;
        Motion force = inertia * wanted;
        for (const std::size_t k : pressing) {
            const Row& row = rows[k];
            held += row.stiffness * row.along * row.along.transpose();
            force -= row.stiffness * row.height * row.along;
        }
        const Motion way = Eigen::LDLT<MotionMatrix>(held).solve(force) - motion;
        if (!way.allFinite()) break;
        motion += least_part([&](double part) {
                      const Motion there = motion + part * way;
                      double slope = way.dot(inertia * (there - wanted));
                      for (const Row& row : rows)
                          slope +=
                              row.stiffness * std::min(0.0, row.height_after(there)) * row.along.dot(way);
                      return slope;
                  }) *
                  way;
        std::vector<std::size_t> next = find_pressing();
        if (next == pressing) break;
        pressing.swap(next);
    }
    return true;
}

template <class Real>
void PlaneLanding<Real>::land(std::uint32_t object, const StepObjective<Real>& objective,
                              std::span<Vec4<Real>> positions) const {
    const Range& nodes = model_->objects[object].nodes;
    if (lands_[object] == 0) return;
    for (int i = 0; i < kMostMotions && is_inside(object, positions); ++i) {
        const glm::dvec3 origin(positions[nodes.first]);
        const auto targets = std::span(objective.step.targets).subspan(nodes.first, nodes.count);
        const RigidSums sums = sum_rigid_nodes(
            std::span<const Vec4<Real>>(positions.subspan(nodes.first, nodes.count)), targets, origin);
        const glm::dvec3 center = origin + sums.arm / sums.stiffness;
        Motion motion = Motion::Zero();
        land(object, objective, positions, center, motion);
        move_rigid_nodes(
            {center, {motion(0), motion(1), motion(2)}, cayley_rotation({motion(3), motion(4), motion(5)})},
            positions.subspan(nodes.first, nodes.count));
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
