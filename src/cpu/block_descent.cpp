#include "cpu/block_descent.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <Eigen/QR>
#include <algorithm>
#include <glm/gtc/quaternion.hpp>

#include "cpu/colliders.h"
#include "mesh/topology.h"
#include "model/solver.h"

namespace gelatin::cpu {
namespace {

constexpr std::uint32_t kNodesATask = 256;

NodeColors color_springs(const Model& model) {
    std::vector<glm::uvec2> edges;
    edges.reserve(model.springs.size());
    for (const Spring& spring : model.springs) edges.emplace_back(spring.i, spring.j);
    return color_nodes(make_graph(model.node_count(), edges));
}

template <class Work>
void for_nodes(const Range& nodes, const Work& work) {
    tbb::parallel_for(tbb::blocked_range<std::uint32_t>(nodes.first, nodes.end(), kNodesATask),
                      [&](const auto& range) {
                          for (std::uint32_t n = range.begin(); n < range.end(); ++n) work(n);
                      });
}

}  // namespace

// What all parts of a step read.
template <class Real>
struct BlockDescent<Real>::Step {
    Real size;  // h [s]
    const Nodes<Real>& previous;
    Vec3<Real> gravity;  // [m/s^2]

    Vec3<Real> start(std::uint32_t n) const { return Vec3<Real>(previous.positions[n]); }
    // Where the node would be without forces: y [m].
    Vec3<Real> target(std::uint32_t n) const {
        return start(n) + size * (Vec3<Real>(previous.velocities[n]) + size * gravity);
    }
};

template <class Real>
BlockDescent<Real>::BlockDescent(std::shared_ptr<const Model> model, int iterations)
    : model_(std::move(model)),
      iterations_(iterations),
      colors_(color_springs(*model_)),
      touches_(model_->node_count(), 0) {
    hack_starts_.assign(model_->node_count() + 1, 0);
    for (auto& t : model_->tets) for (int k = 0; k < 4; ++k) ++hack_starts_[t[k] + 1];
    for (std::size_t n = 0; n < model_->node_count(); ++n) hack_starts_[n + 1] += hack_starts_[n];
    hack_tets_.resize(4 * model_->tets.size());
    auto next = hack_starts_;
    for (std::uint32_t t = 0; t < model_->tets.size(); ++t) for (std::uint32_t k = 0; k < 4; ++k) hack_tets_[next[model_->tets[t][k]]++] = 4 * t + k;
    for (auto& t : model_->tets) { auto x = [&](int i) { return glm::dvec3(hack_rest()[t[i]]); }; hack_volumes_.push_back(glm::dot(glm::cross(x(1) - x(0), x(2) - x(0)), x(3) - x(0)) / 6); }
    double kl2 = 0; for (auto& s : model_->springs) kl2 += double(s.stiffness) * double(s.rest_length) * double(s.rest_length);
    double vol = 0; for (auto v : hack_volumes_) vol += v;
    hack_e_ = kl2 / (6 * vol);
    for (const ModelObject& object : model_->objects) {
        const auto first = model_->positions.begin() + object.nodes.first;
        is_free_.push_back(std::none_of(first, first + object.nodes.count,
                                        [](const glm::vec4& p) { return p.w == 0.0f; }));
    }
}

template <class Real>
void BlockDescent<Real>::run(Real step_size, const Nodes<Real>& previous, Nodes<Real>& current) {
    const Step step{step_size, previous, Vec3<Real>(model_->gravity)};
    guess(step, current);
    for (int i = 0; i < iterations_; ++i) {
        sweep(step, current.positions);
        if (i % 2 == 0 && i + 1 < iterations_) continue;
        tbb::parallel_for(std::size_t(0), model_->objects.size(), [&](std::size_t o) {
            move_rigidly(step, static_cast<std::uint32_t>(o), current.positions);
        });
    }
    finish(step, current);
}

template <class Real>
void BlockDescent<Real>::guess(const Step& step, Nodes<Real>& current) {
    for_nodes({0, model_->node_count()}, [&](std::uint32_t n) {
        const Vec4<Real>& start = step.previous.positions[n];
        current.positions[n] = start.w > Real(0) ? Vec4<Real>(step.target(n), start.w) : start;
        touches_[n] = 0;
    });
}

template <class Real>
void BlockDescent<Real>::sweep(const Step& step, std::vector<Vec4<Real>>& positions) {
    const Model& model = *model_;
    const auto move = [&](std::uint32_t n) {
        const Real inverse_mass = positions[n].w;
        if (inverse_mass == Real(0)) return;
        const Vec3<Real> position(positions[n]), way = position - step.start(n);
        const Real inertia = Real(1) / (inverse_mass * step.size * step.size);  // [N/m]
        NodeTerms<Real> terms{inertia * (step.target(n) - position), Mat3<Real>(inertia)};
        for (std::uint32_t e = model.incidence.starts[n]; e < model.incidence.starts[n + 1]; ++e) {
            const std::uint32_t entry = model.incidence.entries[e];
            const Spring& spring = model.springs[entry / 2];
            const std::uint32_t other = entry % 2 == 0 ? spring.j : spring.i;
            const Vec3<Real> other_position(positions[other]);
            const Real damping_time = Real(0.5) * (step.previous.velocities[n].w + step.previous.velocities[other].w);
            add_spring(position, other_position, way, other_position - step.start(other),
                       any_direction<Real>(n, other), static_cast<Real>(spring.rest_length),
                       static_cast<Real>(spring.stiffness), damping_time / step.size, terms);
        }
        static const double kC = getenv("VC") ? atof(getenv("VC")) : 1.0, kJ0 = getenv("VJ") ? atof(getenv("VJ")) : 0.3;
        for (std::uint32_t e = hack_starts_[n]; e < hack_starts_[n + 1]; ++e) {
            const std::uint32_t t = hack_tets_[e] / 4, c = hack_tets_[e] % 4;
            static constexpr int kOther[4][3] = {{1, 3, 2}, {0, 2, 3}, {0, 3, 1}, {0, 1, 2}};
            const glm::uvec4& tet = model.tets[t];
            const Vec3<Real> a(positions[tet[kOther[c][0]]]), b(positions[tet[kOther[c][1]]]), d(positions[tet[kOther[c][2]]]);
            const Real v0 = static_cast<Real>(hack_volumes_[t]);
            const Vec3<Real> grad = glm::cross(b - a, d - a) / (Real(6) * v0);
            const Real j = glm::dot(position - a, grad);
            if (j >= Real(kJ0)) continue;
            const Real kv = Real(kC) * static_cast<Real>(hack_e_) * v0;
            terms.force += kv * (Real(kJ0) - j) * grad;
            terms.hessian += kv * glm::outerProduct(grad, grad);
        }
        Vec3<Real> moved = position + solve(terms);
        for (const Collider& collider : model.colliders) {
            const SurfaceDistance<Real> surface = surface_distance(collider, moved);
            if (surface.distance >= Real(0)) continue;
            moved -= surface.distance * surface.normal;
            const Vec3<Real> covered = moved - step.start(n);
            const Vec3<Real> slid = covered - glm::dot(covered, surface.normal) * surface.normal;
            const Real length = glm::length(slid), most = -static_cast<Real>(collider.friction) * surface.distance;
            if (length > Real(0)) moved -= std::min(Real(1), most / length) * slid;
            touches_[n] = 1;
        }
        positions[n] = Vec4<Real>(moved, inverse_mass);
    };
    for (std::uint32_t c = 0; c < colors_.count(); ++c) {
        const std::span<const std::uint32_t> nodes = colors_.of(c);
        for_nodes({0, static_cast<std::uint32_t>(nodes.size())}, [&](std::uint32_t k) { move(nodes[k]); });
    }
}

// Internal forces do no work on a rigid motion, so that G changes by its first term alone: the best
// translation takes the centre of mass to that of y, the best small turn t solves
// sum m (r^2 - r r^T) t = sum m r x (y - x).
template <class Real>
void BlockDescent<Real>::move_rigidly(const Step& step, std::uint32_t object,
                                      std::vector<Vec4<Real>>& positions) const {
    const Range& nodes = model_->objects[object].nodes;
    const auto touches = touches_.begin() + nodes.first;
    if (!is_free_[object] ||
        std::any_of(touches, touches + nodes.count, [](std::uint8_t t) { return t != 0; })) {
        return;
    }
    double mass = 0.0;
    glm::dvec3 center(0.0), shift(0.0);
    for (std::uint32_t n = nodes.first; n < nodes.end(); ++n) {
        const double m = 1.0 / static_cast<double>(positions[n].w);
        mass += m;
        center += m * glm::dvec3(positions[n]);
        shift += m * (glm::dvec3(step.target(n)) - glm::dvec3(positions[n]));
    }
    center /= mass;
    shift /= mass;
    Eigen::Matrix3d inertia = Eigen::Matrix3d::Zero();
    glm::dvec3 moment(0.0);
    for (std::uint32_t n = nodes.first; n < nodes.end(); ++n) {
        const double m = 1.0 / static_cast<double>(positions[n].w);
        const glm::dvec3 r = glm::dvec3(positions[n]) - center;
        const Eigen::Vector3d e(r.x, r.y, r.z);
        inertia += m * (e.squaredNorm() * Eigen::Matrix3d::Identity() - e * e.transpose());
        moment += m * glm::cross(r, glm::dvec3(step.target(n)) - glm::dvec3(positions[n]));
    }
    // A body in a line has no inertia about it: the least turn of all that solve.
    const Eigen::Vector3d t =
        inertia.completeOrthogonalDecomposition().solve(Eigen::Vector3d(moment.x, moment.y, moment.z));
    const double angle = t.norm();
    const glm::dquat turn = angle > 0.0 ? glm::angleAxis(std::min(angle, 0.5), glm::dvec3(t[0], t[1], t[2]) / angle)
                                        : glm::dquat(1.0, 0.0, 0.0, 0.0);
    for (std::uint32_t n = nodes.first; n < nodes.end(); ++n) {
        const glm::dvec3 moved = center + shift + turn * (glm::dvec3(positions[n]) - center);
        positions[n] = Vec4<Real>(Vec3<Real>(moved), positions[n].w);
    }
}

// The velocity is the way over the step; nodes that met a collider bounce and slide as those of the explicit
// solvers do, by the velocity that they came with.
template <class Real>
void BlockDescent<Real>::finish(const Step& step, Nodes<Real>& current) const {
    const auto still = static_cast<Real>(resting_speed(model_->gravity, static_cast<double>(step.size)));
    for_nodes({0, model_->node_count()}, [&](std::uint32_t n) {
        const Vec4<Real>& before = step.previous.velocities[n];
        if (current.positions[n].w == Real(0)) {
            current.velocities[n] = before;
            return;
        }
        const Vec3<Real> velocity = (Vec3<Real>(current.positions[n]) - step.start(n)) / step.size;
        current.velocities[n] = Vec4<Real>(velocity, before.w);
        if (!model_->colliders.empty())
            resolve_colliders<Real>(model_->colliders, still, current.positions[n], current.velocities[n]);
    });
}

template class BlockDescent<float>;
template class BlockDescent<double>;

}  // namespace gelatin::cpu
