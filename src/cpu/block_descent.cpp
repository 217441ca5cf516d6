#include "cpu/block_descent.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <span>
#include <utility>

#include "cpu/colliders.h"
#include "cpu/neo_hookean.h"
#include "cpu/rigid_motion.h"
#include "cpu/spring_terms.h"
#include "model/for_each_index.h"
#include "model/solver.h"

namespace gelatin::cpu {
namespace {

// Ways are made longer by no more than this.
constexpr double kFarthest = 2.0;

template <class Work>
void for_each_node(const Model& model, const Work& work) {
    for_each_index(model.node_count(), [&](std::size_t n) { work(static_cast<std::uint32_t>(n)); });
}

void gather_terms(const SpringRows<float>& springs, std::uint32_t slice, NodeTerms<float>* terms) {
    gather_spring_terms_simd(springs, slice, terms);
}

void gather_terms(const SpringRows<double>& springs, std::uint32_t slice, NodeTerms<double>* terms) {
    gather_spring_terms(springs, slice, terms);
}

}  // namespace

template <class Real>
BlockDescent<Real>::BlockDescent(std::shared_ptr<const Model> model, const DescentSettings& settings)
    : model_(std::move(model)),
      settings_(settings),
      rows_(make_descent_rows(*model_)),
      tets_(model_),
      coarse_(model_),
      starts_(model_->node_count()),
      targets_(model_->node_count()),
      object_of_(objects_of_nodes(*model_)),
      touches_(model_->objects.size()) {
    if (!model_->colliders.empty()) node_touches_.resize(model_->node_count());
    if (settings_.chebyshev > 0.0) last_ = before_last_ = targets_;
    if (!coarse_.is_empty()) {
        ahead_.resize(model_->node_count());
        ways_.resize(model_->node_count());
        forces_ = forces_ahead_ = ways_;
    }
}

template <class Real>
void BlockDescent<Real>::run(Real step, bool has_earlier, const Nodes<Real>& previous, Nodes<Real>& current,
                             std::span<const Vec4<Real>> load_forces, const Pulls<Real>* pulls) {
    pulls_ = pulls;
    start(step, has_earlier, previous, load_forces, current);
    take_back_tangled(current.positions);
    coarse_.begin(step, current.positions);
    for (int i = 0; i < settings_.iterations; ++i) {
        if (settings_.chebyshev > 0.0) accelerate(i, current.positions);
        if (i % kSweepsAMotion == 0) tets_.look(current.positions);
        sweep(step, current.positions);
        const bool is_last = i + 1 == settings_.iterations;
        if (!is_last && i % kSweepsACorrection == 0) correct(step, current.positions);
        if (is_last || (i + 1) % kSweepsAMotion == 0) move_bodies(step, is_last, current.positions);
    }
    finish(step, previous, current);
}

// As the last step went on: with as much of gravity as was felt in it, from none, where a body rests, to all,
// where it falls (Chen et al. 2024, 3.7). Without a last step as in free fall. Nodes that are inside a
// collider are put outside first, which is no motion and gives them no speed. Held nodes are where their
// handle takes them.
template <class Real>
void BlockDescent<Real>::start(Real step, bool has_earlier, const Nodes<Real>& previous,
                               std::span<const Vec4<Real>> load_forces, Nodes<Real>& current) {
    const Vec3<Real> gravity(model_->gravity);
    const Real squared = glm::dot(gravity, gravity);
    std::fill(touches_.begin(), touches_.end(), std::uint8_t(0));
    for_each_node(*model_, [&](std::uint32_t n) {
        const Vec3<Real> velocity(previous.velocities[n]);
        const Vec3<Real> gained = velocity - Vec3<Real>(current.velocities[n]);
        Vec4<Real> from = previous.positions[n];
        if (from.w > Real(0)) {
            Vec4<Real> none(0);
            resolve_colliders<Real>(model_->colliders, Real(0), from, none);
        }
        starts_[n] = Vec4<Real>(Vec3<Real>(from), previous.velocities[n].w);
        if (from.w == Real(0)) {
            targets_[n] = Vec3<Real>(from) + step * velocity;
            current.positions[n] = Vec4<Real>(targets_[n], Real(0));
            return;
        }
        Vec3<Real> acceleration = gravity;
        if (!load_forces.empty()) acceleration += from.w * Vec3<Real>(load_forces[n]);
        targets_[n] = Vec3<Real>(from) + step * (velocity + step * acceleration);
        const Real felt = has_earlier && squared > Real(0)
                              ? glm::clamp(glm::dot(gained, gravity) / (step * squared), Real(0), Real(1))
                              : Real(1);
        const Vec3<Real> guess = Vec3<Real>(from) + step * (velocity + step * felt * gravity);
        current.positions[n] = Vec4<Real>(guess, from.w);
    });
}

// A guess that tangles a body can hold any energy, which few sweeps would not take out again. From where the
// body was they do not come to more than it had.
template <class Real>
void BlockDescent<Real>::take_back_tangled(std::vector<Vec4<Real>>& positions) const {
    tbb::parallel_for(std::size_t(0), model_->objects.size(), [&](std::size_t o) {
        const ModelObject& object = model_->objects[o];
        if (!tets_.is_tangled(object, positions)) return;
        for (std::uint32_t n = object.nodes.first; n < object.nodes.end(); ++n) {
            if (positions[n].w == Real(0)) continue;  // held ones are where their handle takes them
            positions[n] = Vec4<Real>(Vec3<Real>(starts_[n]), positions[n].w);
        }
    });
}

// Chebyshev's semi-iterative method (Golub, Varga 1961; for nonlinear sweeps Wang 2015): sweep k starts at
//   x_k = w_k (x - x_(k-2)) + x_(k-2),  w_1 = 1,  w_2 = 2 / (2 - rho^2),  w_k = 4 / (4 - rho^2 w_(k-1)),
// with x what the last one has found, so that what comes last is a sweep, which colliders have seen. Bodies
// that touch one are left alone: what holds them changes from sweep to sweep.
template <class Real>
void BlockDescent<Real>::accelerate(int sweep, std::vector<Vec4<Real>>& positions) {
    const auto weight = static_cast<Real>(chebyshev_weight(settings_.chebyshev, sweep));
    for_each_node(*model_, [&](std::uint32_t n) {
        Vec3<Real> x(positions[n]);
        if (sweep > 1 && touches_[object_of_[n]] == 0) x = weight * (x - before_last_[n]) + before_last_[n];
        before_last_[n] = last_[n];
        last_[n] = x;
        positions[n] = Vec4<Real>(x, positions[n].w);
    });
}

template <class Real>
void BlockDescent<Real>::sweep(Real step, std::vector<Vec4<Real>>& positions) {
    constexpr std::uint32_t kSlice = HalfSprings::kSlice;
    const SpringRows<Real> springs{rows_, positions.data(), starts_.data(), Real(1) / step};
    for (const Range& color : rows_.colors) {
        tbb::parallel_for(color.first / kSlice, color.end() / kSlice, [&](std::uint32_t slice) {
            std::array<NodeTerms<Real>, kSlice> terms;
            gather_terms(springs, slice, terms.data());
            for (std::uint32_t row = 0; row < kSlice; ++row) {
                const std::uint32_t node = rows_.nodes[slice * kSlice + row];
                if (node != kNoNode) move_node(node, step, terms[row], positions);
            }
        });
    }
}

// All of a node's, to those of its springs.
template <class Real>
void BlockDescent<Real>::add_node_terms(std::uint32_t node, Real step,
                                        const std::vector<Vec4<Real>>& positions,
                                        NodeTerms<Real>& terms) const {
    const Vec4<Real>& position = positions[node];
    const Real inertia = Real(1) / (position.w * step * step);  // [N/m]
    terms.force += inertia * (targets_[node] - Vec3<Real>(position));
    terms.hessian.add_identity(inertia);
    if (pulls_ != nullptr) {
        const Vec4<Real> pull = pulls_->terms(node, Vec3<Real>(position), Vec3<Real>(starts_[node]), step);
        terms.force += Vec3<Real>(pull);
        terms.hessian.add_identity(pull.w);
    }
    tets_.add(node, positions, terms);
    add_neo_hookean_tets(node, step, positions, terms);
}

// @param terms of its springs
template <class Real>
void BlockDescent<Real>::move_node(std::uint32_t node, Real step, NodeTerms<Real> terms,
                                   std::vector<Vec4<Real>>& positions) {
    const Vec4<Real> position = positions[node];
    if (position.w == Real(0)) return;
    add_node_terms(node, step, positions, terms);
    const Vec3<Real> moved = outside_colliders(node, terms.hessian, Vec3<Real>(position) + solve(terms));
    positions[node] = Vec4<Real>(moved, position.w);
}

// Minus the slope of the objective by each node; colliders left out.
template <class Real>
void BlockDescent<Real>::find_forces(Real step, const std::vector<Vec4<Real>>& positions,
                                     std::vector<Vec3<Real>>& forces) const {
    constexpr std::uint32_t kSlice = HalfSprings::kSlice;
    const SpringRows<Real> springs{rows_, positions.data(), starts_.data(), Real(1) / step};
    const auto slices = static_cast<std::uint32_t>(rows_.nodes.size()) / kSlice;
    tbb::parallel_for(std::uint32_t(0), slices, [&](std::uint32_t slice) {
        std::array<NodeTerms<Real>, kSlice> terms;
        gather_terms(springs, slice, terms.data());
        for (std::uint32_t row = 0; row < kSlice; ++row) {
            const std::uint32_t node = rows_.nodes[slice * kSlice + row];
            if (node == kNoNode || positions[node].w == Real(0)) continue;
            add_node_terms(node, step, positions, terms[row]);
            forces[node] = terms[row].force;
        }
    });
}

// All nodes at once along the motions of clusters, as far as the objective falls.
template <class Real>
void BlockDescent<Real>::correct(Real step, std::vector<Vec4<Real>>& positions) {
    if (coarse_.is_empty()) return;
    const auto is_touched = [&](std::uint32_t n) {
        return !node_touches_.empty() && touches_[object_of_[n]] != 0;
    };
    find_forces(step, positions, forces_);
    for_each_node(*model_, [&](std::uint32_t n) {
        if (is_touched(n)) forces_[n] += node_touches_[n].force;
    });
    coarse_.find_ways(positions, forces_, ways_);
    for_each_node(*model_,
                  [&](std::uint32_t n) { ahead_[n] = positions[n] + Vec4<Real>(ways_[n], Real(0)); });
    find_forces(step, ahead_, forces_ahead_);
    for_each_node(*model_, [&](std::uint32_t n) {
        if (!is_touched(n)) return;
        const Touch& touch = node_touches_[n];
        const Real along = glm::dot(touch.normal, ways_[n]);
        forces_ahead_[n] +=
            touch.force - touch.across * ways_[n] - (touch.along - touch.across) * along * touch.normal;
    });
    tbb::parallel_for(std::size_t(0), model_->objects.size(), [&](std::size_t o) {
        if (!coarse_.moves(o)) return;
        const Real factor = way_factor(o);
        if (factor == Real(0)) return;
        const Range& nodes = model_->objects[o].nodes;
        for (std::uint32_t n = nodes.first; n < nodes.end(); ++n)
            positions[n] += Vec4<Real>(factor * ways_[n], Real(0));
    });
}

// The part of an object's ways at which what acts along them is nothing, by the secant through its values
// here and at the ways' ends. No node goes farther than the object is long.
template <class Real>
Real BlockDescent<Real>::way_factor(std::size_t object) const {
    double here = 0.0, ahead = 0.0, longest = 0.0;  // [J], [m]
    const Range& nodes = model_->objects[object].nodes;
    for (std::uint32_t n = nodes.first; n < nodes.end(); ++n) {
        here += static_cast<double>(glm::dot(forces_[n], ways_[n]));
        ahead += static_cast<double>(glm::dot(forces_ahead_[n], ways_[n]));
        longest = std::max(longest, static_cast<double>(glm::length(ways_[n])));
    }
    if (!(here > 0.0 && std::isfinite(here) && std::isfinite(ahead))) return Real(0);
    const double factor = here / std::max(here - ahead, here / kFarthest);
    return static_cast<Real>(std::min(factor, coarse_.length(object) / longest));
}

template <class Real>
void BlockDescent<Real>::add_neo_hookean_tets(std::uint32_t node, Real step,
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
        const Real damping_time = mean_damping_time(tet, starts_.data());
        if (damping_time > Real(0)) {
            const Mat3<Real> start = gradient_of(tet, at_corners(tet, starts_.data()));
            add_viscosity(g, f, start, volume, mu, lambda, damping_time / step, terms);
        }
    }
}

// Where the node's own objective, to second order, is least outside the collider's tangent plane, behind
// which all of it lies: the normal force is what that takes. Friction then takes back what the node has slid
// along the plane, with as much force as Coulomb's law allows.
template <class Real>
Vec3<Real> BlockDescent<Real>::outside_colliders(std::uint32_t node, const SymmetricMatrix<Real>& hessian,
                                                 Vec3<Real> position) {
    if (node_touches_.empty()) return position;
    Touch touch;
    for (const Collider& collider : model_->colliders) {
        if (is_above_plane(collider, position)) continue;  // as most nodes are
        const SurfaceDistance<Real> surface = surface_distance(collider, position);
        if (surface.distance >= Real(0)) continue;
        const Vec3<Real>& n = surface.normal;
        const Vec3<Real> yielding = solve(hessian, n);  // to a force along n
        const Real compliance = glm::dot(n, yielding);
        if (!(compliance > Real(0))) {  // lost in rounding
            position -= surface.distance * n;
            continue;
        }
        const Real stiffness = Real(1) / compliance;
        const Real pressing = -surface.distance * stiffness;
        position += pressing * yielding;
        touch.force += pressing * n;
        touch.normal = n;
        touch.along = stiffness;
        touch.across = Real(0);
        std::atomic_ref(touches_[object_of_[node]]).store(1, std::memory_order_relaxed);

        const Vec3<Real> way = position - Vec3<Real>(starts_[node]);
        const Vec3<Real> slid = way - glm::dot(way, n) * n;
        const Real length = glm::length(slid);
        if (length == Real(0)) continue;
        const Vec3<Real> t = slid / length;
        Vec3<Real> giving = solve(hessian, t);
        giving -= stiffness * glm::dot(n, giving) * yielding;  // within the plane
        const Real sliding_compliance = glm::dot(t, giving);
        if (!(sliding_compliance > Real(0))) continue;
        const Real needed = length / sliding_compliance;
        const Real most = static_cast<Real>(collider.friction) * pressing;
        position -= std::min(needed, most) * giving;
        touch.force -= std::min(needed, most) * t;
        // It falls to nothing where all of the way is taken back.
        const Real left = length - std::min(needed, most) * sliding_compliance;
        touch.across = most < stiffness * left ? most / left : stiffness;
    }
    if (touch.along > Real(0) || node_touches_[node].along > Real(0)) node_touches_[node] = touch;
    return position;
}

// The last sweep has left nodes outside colliders: bodies that touch one do not move after it.
template <class Real>
void BlockDescent<Real>::move_bodies(Real step, bool is_last, std::vector<Vec4<Real>>& positions) const {
    const double inertia = 1.0 / (static_cast<double>(step) * static_cast<double>(step));
    tbb::parallel_for(std::size_t(0), model_->objects.size(), [&](std::size_t o) {
        const Range& nodes = model_->objects[o].nodes;
        const std::span body_nodes(positions.data() + nodes.first, nodes.count);
        const bool is_held = std::any_of(body_nodes.begin(), body_nodes.end(),
                                         [](const Vec4<Real>& p) { return p.w == Real(0); });
        if (is_held || (is_last && touches_[o] != 0)) return;
        const glm::dvec3 origin(positions[nodes.first]);
        RigidStep body;
        for (std::uint32_t n = nodes.first; n < nodes.end(); ++n) {
            const glm::dvec3 position(positions[n]), r = position - origin;
            const double stiffness = inertia / static_cast<double>(positions[n].w);
            body.add(r, stiffness, stiffness * (glm::dvec3(targets_[n]) - position));
            if (pulls_ != nullptr) {
                const Vec4<Real> pull =
                    pulls_->terms(n, Vec3<Real>(positions[n]), Vec3<Real>(starts_[n]), step);
                body.add(r, static_cast<double>(pull.w), glm::dvec3(pull));
            }
            if (touches_[o] == 0 || node_touches_[n].along == Real(0)) continue;
            const Touch& touch = node_touches_[n];
            body.add(r, static_cast<double>(touch.across), glm::dvec3(touch.force));
            body.add_along(r, glm::dvec3(touch.normal), static_cast<double>(touch.along - touch.across));
        }
        const RigidMotion motion = body.solve(origin);
        for (std::uint32_t n = nodes.first; n < nodes.end(); ++n)
            positions[n] = Vec4<Real>(Vec3<Real>(motion.move(glm::dvec3(positions[n]))), positions[n].w);
    });
}

// Nodes that a collider has stopped go back with restitution times the speed they would have had without it.
template <class Real>
void BlockDescent<Real>::finish(Real step, const Nodes<Real>& previous, Nodes<Real>& current) const {
    const auto least = static_cast<Real>(resting_speed(model_->gravity, static_cast<double>(step)));
    for_each_node(*model_, [&](std::uint32_t n) {
        const Vec4<Real> old = previous.velocities[n];
        current.velocities[n] = old;
        if (current.positions[n].w == Real(0)) return;
        const Vec3<Real> position(current.positions[n]), start(starts_[n]);
        Vec3<Real> velocity = (position - start) / step;
        if (touches_[object_of_[n]] != 0)
            rebound<Real>(model_->colliders, position, (targets_[n] - start) / step, least, velocity);
        current.velocities[n] = Vec4<Real>(velocity, old.w);
    });
}

template class BlockDescent<float>;
template class BlockDescent<double>;

}  // namespace gelatin::cpu
