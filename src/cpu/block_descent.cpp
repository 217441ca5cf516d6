#include "cpu/block_descent.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <utility>

#include "cpu/colliders.h"
#include "cpu/neo_hookean.h"
#include "cpu/rigid_motion.h"
#include "model/solver.h"

namespace gelatin::cpu {
namespace {

constexpr std::uint32_t kItemsATask = 256;
constexpr int kSweepsAMotion = 2;

template <class Work>
void for_each(std::uint32_t count, const Work& work) {
    tbb::parallel_for(tbb::blocked_range<std::uint32_t>(0, count, kItemsATask), [&](const auto& range) {
        for (std::uint32_t i = range.begin(); i < range.end(); ++i) work(i);
    });
}

}  // namespace

template <class Real>
BlockDescent<Real>::BlockDescent(std::shared_ptr<const Model> model, int iterations)
    : model_(std::move(model)),
      iterations_(iterations),
      colors_(color_nodes(*model_)),
      node_tets_(make_node_tets(model_->node_count(), model_->tets)),
      targets_(model_->node_count()),
      near_flat_(model_->node_count()),
      touches_(model_->node_count()) {
    for (const ModelObject& object : model_->objects) {
        const auto first = model_->positions.begin() + object.nodes.first;
        is_pinned_.push_back(
            std::any_of(first, first + object.nodes.count, [](const glm::vec4& p) { return p.w == 0.0f; }));
    }
}

template <class Real>
void BlockDescent<Real>::run(Real step, const Nodes<Real>& previous, Nodes<Real>& current) {
    start(step, previous, current.positions);
    for (int i = 0; i < iterations_; ++i) {
        if (i % kSweepsAMotion == 0) mark_nodes_of_flat_tets(current.positions);
        sweep(step, previous, current.positions);
        const bool is_last = i + 1 == iterations_;
        if (is_last || (i + 1) % kSweepsAMotion == 0) move_bodies(current.positions);
    }
    finish(step, previous, current);
}

// Where the nodes would be without forces, which is exact in free fall.
template <class Real>
void BlockDescent<Real>::start(Real step, const Nodes<Real>& previous, std::vector<Vec4<Real>>& positions) {
    const Vec3<Real> gravity(model_->gravity);
    for_each(model_->node_count(), [&](std::uint32_t n) {
        const Vec4<Real>& from = previous.positions[n];
        const Vec3<Real> velocity(previous.velocities[n]);
        targets_[n] = Vec3<Real>(from);
        if (from.w > Real(0)) targets_[n] += step * (velocity + step * gravity);
        positions[n] = Vec4<Real>(targets_[n], from.w);
        touches_[n] = 0;
    });
}

template <class Real>
void BlockDescent<Real>::mark_nodes_of_flat_tets(const std::vector<Vec4<Real>>& positions) {
    std::fill(near_flat_.begin(), near_flat_.end(), std::uint8_t(0));
    for_each(static_cast<std::uint32_t>(model_->tets.size()), [&](std::uint32_t t) {
        const glm::uvec4& tet = model_->tets[t];
        const Vec3<Real> a(positions[tet.x]);
        const Vec3<Real> u = Vec3<Real>(positions[tet.y]) - a, v = Vec3<Real>(positions[tet.z]) - a,
                         w = Vec3<Real>(positions[tet.w]) - a;
        const Real least =
            static_cast<Real>(kFlattest) * Real(6) * static_cast<Real>(model_->tet_rests[t].volume);
        if (glm::dot(glm::cross(u, v), w) >= least) return;
        for (int k = 0; k < 4; ++k) std::atomic_ref(near_flat_[tet[k]]).store(1, std::memory_order_relaxed);
    });
}

template <class Real>
void BlockDescent<Real>::sweep(Real step, const Nodes<Real>& previous, std::vector<Vec4<Real>>& positions) {
    for (std::uint32_t c = 0; c < colors_.count(); ++c) {
        const std::span<const std::uint32_t> nodes = colors_.of(c);
        for_each(static_cast<std::uint32_t>(nodes.size()),
                 [&](std::uint32_t k) { move_node(nodes[k], step, previous, positions); });
    }
}

template <class Real>
void BlockDescent<Real>::move_node(std::uint32_t node, Real step, const Nodes<Real>& previous,
                                   std::vector<Vec4<Real>>& positions) {
    const Real inverse_mass = positions[node].w;
    if (inverse_mass == Real(0)) return;
    const Model& model = *model_;
    const auto way = [&](std::uint32_t n) {
        return Vec3<Real>(positions[n]) - Vec3<Real>(previous.positions[n]);
    };
    const Vec3<Real> position(positions[node]);
    const Real inertia = Real(1) / (inverse_mass * step * step);  // [N/m]
    NodeTerms<Real> terms{inertia * (targets_[node] - position), {}};
    terms.hessian.add_identity(inertia);
    const Vec3<Real> if_coincident = any_direction<Real>(node);

    for (std::uint32_t e = model.incidence.starts[node]; e < model.incidence.starts[node + 1]; ++e) {
        const std::uint32_t entry = model.incidence.entries[e];
        const Spring& spring = model.springs[entry / 2];
        const std::uint32_t other = entry % 2 == 0 ? spring.j : spring.i;
        const Real damping_time = Real(0.5) * (previous.velocities[node].w + previous.velocities[other].w);
        add_spring(Vec3<Real>(positions[other]) - position, way(other) - way(node), if_coincident,
                   static_cast<Real>(spring.rest_length), static_cast<Real>(spring.stiffness),
                   damping_time / step, terms);
    }
    const std::uint32_t end = near_flat_[node] != 0 ? node_tets_.starts[node + 1] : 0;
    for (std::uint32_t e = node_tets_.starts[node]; e < end; ++e) {
        const std::uint32_t tet = node_tets_.entries[e] / 4, corner = node_tets_.entries[e] % 4;
        std::array<Vec3<Real>, 3> face;
        for (std::size_t k = 0; k < 3; ++k) face[k] = positions[model.tets[tet][kOppositeCorners[corner][k]]];
        add_flat_tet(position, face, static_cast<Real>(model.tet_rests[tet].volume),
                     static_cast<Real>(model.tet_rests[tet].modulus), terms);
    }
    add_neo_hookean_tets(node, step, previous, positions, terms);
    const Vec3<Real> moved =
        outside_colliders(node, Vec3<Real>(previous.positions[node]), position + solve(terms));
    positions[node] = Vec4<Real>(moved, inverse_mass);
}

template <class Real>
void BlockDescent<Real>::add_neo_hookean_tets(std::uint32_t node, Real step, const Nodes<Real>& previous,
                                              const std::vector<Vec4<Real>>& positions,
                                              NodeTerms<Real>& terms) const {
    if (model_->neo_hookean_tets.empty()) return;
    const NodeTets& corners = model_->neo_hookean_corners;
    for (std::uint32_t e = corners.starts[node]; e < corners.starts[node + 1]; ++e) {
        const NeoHookeanTet& tet = model_->neo_hookean_tets[corners.entries[e] / 4];
        const Real volume = static_cast<Real>(tet.gradient_1.w), mu = static_cast<Real>(tet.gradient_2.w),
                   lambda = static_cast<Real>(tet.gradient_3.w);
        const Vec3<Real> g = shape_gradient<Real>(tet, corners.entries[e] % 4);
        const Mat3<Real> f = gradient_of(tet, at_corners(tet, positions.data()));
        add_neo_hookean(g, f, volume, mu, lambda, terms);
        const Real damping_time = mean_damping_time(tet, previous.velocities.data());
        if (damping_time > Real(0)) {
            const Mat3<Real> start = gradient_of(tet, at_corners(tet, previous.positions.data()));
            add_viscosity(g, f, start, volume, mu, lambda, damping_time / step, terms);
        }
    }
}

// Pushed out of colliders it slides by Coulomb's law: what it is pushed by is the normal force over the
// node's own stiffness, and so is the way that friction takes back.
template <class Real>
Vec3<Real> BlockDescent<Real>::outside_colliders(std::uint32_t node, const Vec3<Real>& start,
                                                 Vec3<Real> position) {
    for (const Collider& collider : model_->colliders) {
        const SurfaceDistance<Real> surface = surface_distance(collider, position);
        if (surface.distance >= Real(0)) continue;
        position -= surface.distance * surface.normal;
        const Vec3<Real> way = position - start;
        const Vec3<Real> slid = way - glm::dot(way, surface.normal) * surface.normal;
        const Real length = glm::length(slid);
        const Real held = -static_cast<Real>(collider.friction) * surface.distance;
        if (length > Real(0)) position -= std::min(Real(1), held / length) * slid;
        touches_[node] = 1;
    }
    return position;
}

// Internal forces do no work on a rigid motion: of G only the first term changes.
template <class Real>
void BlockDescent<Real>::move_bodies(std::vector<Vec4<Real>>& positions) const {
    tbb::parallel_for(std::size_t(0), model_->objects.size(), [&](std::size_t o) {
        const Range& nodes = model_->objects[o].nodes;
        const std::span touches(touches_.data() + nodes.first, nodes.count);
        if (is_pinned_[o] || std::any_of(touches.begin(), touches.end(), [](auto t) { return t != 0; }))
            return;
        const std::span body(positions.data() + nodes.first, nodes.count);
        const RigidMotion motion =
            nearest_rigid_motion<Real>(body, {targets_.data() + nodes.first, nodes.count});
        for (Vec4<Real>& p : body) p = Vec4<Real>(Vec3<Real>(motion.move(glm::dvec3(p))), p.w);
    });
}

template <class Real>
void BlockDescent<Real>::finish(Real step, const Nodes<Real>& previous, Nodes<Real>& current) const {
    for_each(model_->node_count(), [&](std::uint32_t n) {
        current.velocities[n] = previous.velocities[n];
        if (current.positions[n].w == Real(0)) return;
        const Vec3<Real> way = Vec3<Real>(current.positions[n]) - Vec3<Real>(previous.positions[n]);
        current.velocities[n] = Vec4<Real>(way / step, previous.velocities[n].w);
    });
}

template class BlockDescent<float>;
template class BlockDescent<double>;

}  // namespace gelatin::cpu
