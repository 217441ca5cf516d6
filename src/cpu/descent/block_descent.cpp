#include "cpu/descent/block_descent.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <span>
#include <utility>

#include "cpu/collision/colliders.h"
#include "cpu/descent/rigid_nodes.h"
#include "model/for_each_index.h"
#include "model/solver.h"

namespace gelatin::cpu {
namespace {

template <class Work>
void for_each_node(const Model& model, const Work& work) {
    for_each_index(model.node_count(), [&](std::size_t n) { work(static_cast<std::uint32_t>(n)); });
}

}  // namespace

template <class Real>
BlockDescent<Real>::BlockDescent(std::shared_ptr<const Model> model, const DescentSettings& settings,
                                 std::uint32_t nodes_a_batch)
    : model_(std::move(model)),
      settings_(settings),
      objective_(model_, nodes_a_batch),
      contacts_{objects_of_nodes(*model_), std::vector<std::uint8_t>(model_->objects.size()), {}} {
    if (settings_.coarse_level) coarse_.emplace(model_);
    if (coarse_ && coarse_->is_empty()) coarse_.reset();
    if (!model_->colliders.empty()) contacts_.nodes.resize(model_->node_count());
    if constexpr (kIsFloat<Real>) collider_bounds_ = make_collider_bounds(model_->colliders);
}

template <class Real>
void BlockDescent<Real>::run(Real step, bool has_earlier, const Nodes<Real>& previous, Nodes<Real>& current,
                             std::span<const Vec4<Real>> load_forces, const Pulls<Real>* pulls,
                             StageTimer* timer) {
    {
        const TimedStage part(timer, "advance_nodes.start");
        start(step, has_earlier, previous, load_forces, pulls, current);
        take_back_tangled(current.positions);
        if (coarse_) coarse_->begin(step, current.positions);
    }
    for (int first = 0; first < settings_.iterations;) {
        const int end = end_of_run(first);
        make_sweeps(first, end, current.positions, timer);
        if (end < settings_.iterations) {
            const TimedStage part(timer, "advance_nodes.correct");
            coarse_->run(objective_, contacts_, current.positions);
        }
        first = end;
    }
    const TimedStage part(timer, "advance_nodes.move_bodies");
    finish(step, previous, current);
}

// Sweeps from `first` up to `end`. The bodies of a batch make theirs one after the other, while caches hold
// them; where parts are timed, all bodies make each part at once, with the same results.
template <class Real>
void BlockDescent<Real>::make_sweeps(int first, int end, std::vector<Vec4<Real>>& positions,
                                     StageTimer* timer) {
    const std::vector<DescentBatch>& batches = objective_.rows().batches;
    const auto for_batches = [&](const auto& work) {
        tbb::parallel_for(std::size_t(0), batches.size(), work);
    };
    if (timer == nullptr) {
        for_batches([&](std::size_t batch) {
            for (int i = first; i < end; ++i) make_sweep(i, batch, positions);
        });
        return;
    }
    const auto time = [&](const char* name, const auto& work) {
        const TimedStage part(timer, name);
        for_batches(work);
    };
    for (int i = first; i < end; ++i) {
        if (updates_tets(i))
            time("advance_nodes.update_tets",
                 [&](std::size_t batch) { objective_.update(batch, positions); });
        time("advance_nodes.descend", [&](std::size_t batch) { sweep(batch, positions); });
        if (!moves_bodies(i)) continue;
        const bool is_last = i + 1 == settings_.iterations;
        time("advance_nodes.move_bodies",
             [&](std::size_t batch) { move_bodies(batches[batch].objects, is_last, positions); });
    }
}

// Of sweeps that no correction comes between.
template <class Real>
int BlockDescent<Real>::end_of_run(int first) const {
    if (!coarse_) return settings_.iterations;
    const int corrected = (first + kSweepsACorrection - 1) / kSweepsACorrection * kSweepsACorrection;
    return std::min(corrected + 1, settings_.iterations);
}

template <class Real>
void BlockDescent<Real>::make_sweep(int index, std::size_t batch, std::vector<Vec4<Real>>& positions) {
    const DescentBatch& bodies = objective_.rows().batches[batch];
    if (updates_tets(index)) objective_.update(batch, positions);
    sweep(batch, positions);
    if (moves_bodies(index)) move_bodies(bodies.objects, index + 1 == settings_.iterations, positions);
}

// As the last step went on: with as much of gravity as was felt in it, from none, where a body rests, to all,
// where it falls (Chen et al. 2024, 3.7). Without a last step as in free fall. Nodes that are inside a
// collider are put outside first, which is no motion and gives them no speed. Held nodes are where their
// handle takes them.
template <class Real>
void BlockDescent<Real>::start(Real step, bool has_earlier, const Nodes<Real>& previous,
                               std::span<const Vec4<Real>> load_forces, const Pulls<Real>* pulls,
                               Nodes<Real>& current) {
    const Vec3<Real> gravity(model_->gravity);
    const Real squared = glm::dot(gravity, gravity);
    for_each_node(*model_, [&](std::uint32_t n) {
        const Vec3<Real> velocity(previous.velocities[n]);
        const Vec3<Real> gained = velocity - Vec3<Real>(current.velocities[n]);
        Vec4<Real> from = previous.positions[n];
        if (from.w > Real(0)) {
            Vec4<Real> none(0);
            resolve_colliders<Real>(model_->colliders, Real(0), from, none);
        }
        objective_.starts[n] = Vec4<Real>(Vec3<Real>(from), previous.velocities[n].w);
        if (contacts_.has_contact(n)) contacts_.nodes[n] = {};  // of the last step
        if (from.w == Real(0)) {
            objective_.targets[n] = Vec4<Real>(Vec3<Real>(from) + step * velocity, Real(0));
            current.positions[n] = objective_.targets[n];
            return;
        }
        Vec3<Real> acceleration = gravity;
        if (!load_forces.empty()) acceleration += from.w * Vec3<Real>(load_forces[n]);
        objective_.targets[n] = Vec4<Real>(Vec3<Real>(from) + step * (velocity + step * acceleration),
                                           Real(1) / (from.w * step * step));
        if (pulls != nullptr)
            objective_.targets[n] = pulls->with_target(n, objective_.targets[n], Vec3<Real>(from), step);
        const Real felt = has_earlier && squared > Real(0)
                              ? glm::clamp(glm::dot(gained, gravity) / (step * squared), Real(0), Real(1))
                              : Real(1);
        const Vec3<Real> guess = Vec3<Real>(from) + step * (velocity + step * felt * gravity);
        current.positions[n] = Vec4<Real>(guess, from.w);
    });
    std::fill(contacts_.objects.begin(), contacts_.objects.end(), std::uint8_t(0));
    objective_.begin(step);
}

// A guess that tangles a body can hold any energy, which few sweeps would not take out again. From where the
// body was they do not come to more than it had.
template <class Real>
void BlockDescent<Real>::take_back_tangled(std::vector<Vec4<Real>>& positions) const {
    tbb::parallel_for(std::size_t(0), model_->objects.size(), [&](std::size_t o) {
        const ModelObject& object = model_->objects[o];
        if (!objective_.is_tangled(object, positions)) return;
        for (std::uint32_t n = object.nodes.first; n < object.nodes.end(); ++n) {
            if (positions[n].w == Real(0)) continue;  // held ones are where their handle takes them
            positions[n] = Vec4<Real>(Vec3<Real>(objective_.starts[n]), positions[n].w);
        }
    });
}

template <class Real>
void BlockDescent<Real>::sweep(std::size_t batch, std::vector<Vec4<Real>>& positions) {
    const DescentRows& rows = objective_.rows();
    const DescentBatch& bodies = rows.batches[batch];
    if constexpr (kIsFloat<Real>) {
        const DescentGroups groups = objective_.groups(collider_bounds_);
        const bool any_flat_tets = objective_.any_flat_tets(batch);
        const std::span in_contact(contacts_.objects.data() + bodies.objects.first, bodies.objects.count);
        const bool any_contact =
            std::any_of(in_contact.begin(), in_contact.end(), [](auto t) { return t != 0; });
        for (const Range& color : bodies.colors) {
            for_each_index(color.first / kGroup, color.end() / kGroup, kGroupsATask, [&](std::size_t group) {
                move_group(groups, group, any_flat_tets, any_contact, positions);
            });
        }
    } else {
        for (const Range& color : bodies.colors) {
            for_each_index(color.first, color.end(), kGroup * kGroupsATask, [&](std::size_t row) {
                const std::uint32_t node = rows.nodes[row];
                if (node == kNoNode || objective_.targets[node].w == Real(0)) return;
                move_node(node, objective_.terms_of(static_cast<std::uint32_t>(row), positions), positions);
            });
        }
    }
}

// @param any_flat_tets whether any in the batch are flat @param any_contact whether nodes touched a collider
// in the last sweep
template <class Real>
template <class Groups>
void BlockDescent<Real>::move_group(const Groups& groups, std::size_t group, bool any_flat_tets,
                                    bool any_contact, std::vector<Vec4<Real>>& positions) {
    TermColumns terms;
    if (any_flat_tets) {
        for (std::uint32_t row = 0; row < kGroup; ++row) {
            const std::uint32_t node = groups.nodes[group * kGroup + row];
            if (node == kNoNode) continue;
            NodeTerms<Real> of_tets;
            objective_.add_flat_tets(node, positions, of_tets);
            terms.add(row, of_tets);
        }
    }
    const std::uint32_t near_colliders = descend_group(groups, group, terms, positions);
    if (near_colliders == 0 && !any_contact) return;
    for (std::uint32_t row = 0; row < kGroup; ++row) {
        const std::uint32_t node = groups.nodes[group * kGroup + row];
        if ((near_colliders >> row & 1u) != 0) {
            const NodeTerms<Real> own = terms.row(row);
            const Vec3<Real> moved = outside_colliders(node, own.hessian, Vec3<Real>(positions[node]));
            positions[node] = Vec4<Real>(moved, positions[node].w);
        } else if (any_contact && node != kNoNode) {
            contacts_.nodes[node] = {};
        }
    }
}

template <class Real>
void BlockDescent<Real>::move_node(std::uint32_t node, const NodeTerms<Real>& terms,
                                   std::vector<Vec4<Real>>& positions) {
    const Vec3<Real> moved =
        outside_colliders(node, terms.hessian, Vec3<Real>(positions[node]) + solve(terms));
    positions[node] = Vec4<Real>(moved, positions[node].w);
}

// Where the node's own objective, to second order, is least outside the collider's tangent plane, behind
// which all of it lies: the normal force is what that takes. Friction then takes back what the node has slid
// along the plane, with as much force as Coulomb's law allows.
template <class Real>
Vec3<Real> BlockDescent<Real>::outside_colliders(std::uint32_t node, const SymmetricMatrix<Real>& hessian,
                                                 Vec3<Real> position) {
    if (contacts_.nodes.empty()) return position;
    ColliderContact<Real> contact;
    for (const Collider& collider : model_->colliders) {
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
        contact.force += pressing * n;
        contact.normal = n;
        contact.along = stiffness;
        contact.across = Real(0);
        std::atomic_ref(contacts_.objects[contacts_.object_of[node]]).store(1, std::memory_order_relaxed);

        const Vec3<Real> displacement = position - Vec3<Real>(objective_.starts[node]);
        const Vec3<Real> slid = displacement - glm::dot(displacement, n) * n;
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
        contact.force -= std::min(needed, most) * t;
        // It falls to nothing where all sliding is taken back.
        const Real left = length - std::min(needed, most) * sliding_compliance;
        contact.across = most < stiffness * left ? most / left : stiffness;
    }
    if (contact.along > Real(0) || contacts_.nodes[node].along > Real(0)) contacts_.nodes[node] = contact;
    return position;
}

// The last sweep has left nodes outside colliders: bodies that touch one do not move after it.
template <class Real>
void BlockDescent<Real>::move_bodies(const Range& objects, bool is_last,
                                     std::vector<Vec4<Real>>& positions) const {
    tbb::parallel_for(objects.first, objects.end(), [&](std::uint32_t o) {
        const Range& nodes = model_->objects[o].nodes;
        const std::span body_nodes(positions.data() + nodes.first, nodes.count);
        const bool is_held = std::any_of(body_nodes.begin(), body_nodes.end(),
                                         [](const Vec4<Real>& p) { return p.w == Real(0); });
        if (is_held || (is_last && contacts_.objects[o] != 0)) return;
        const glm::dvec3 origin(positions[nodes.first]);
        const std::span targets(objective_.targets.data() + nodes.first, nodes.count);
        RigidStep body;
        if constexpr (kIsFloat<Real>) {
            body.add(sum_rigid_nodes(body_nodes, targets, glm::vec3(origin)));
        } else {
            for (std::size_t n = 0; n < body_nodes.size(); ++n) {
                const glm::dvec3 position(body_nodes[n]);
                body.add(position - origin, targets[n].w, targets[n].w * (glm::dvec3(targets[n]) - position));
            }
        }
        if (contacts_.objects[o] != 0) {
            for (std::uint32_t n = nodes.first; n < nodes.end(); ++n) add_contact(n, origin, positions, body);
        }
        const RigidMotion motion = body.solve(origin);
        if constexpr (kIsFloat<Real>) {
            move_rigid_nodes(motion, body_nodes);
        } else {
            for (Vec4<Real>& p : body_nodes) p = Vec4<Real>(motion.move(glm::dvec3(p)), p.w);
        }
    });
}

template <class Real>
void BlockDescent<Real>::add_contact(std::uint32_t node, const glm::dvec3& origin,
                                     const std::vector<Vec4<Real>>& positions, RigidStep& body) const {
    const ColliderContact<Real>& contact = contacts_.nodes[node];
    if (contact.along == Real(0)) return;
    const glm::dvec3 force(contact.force), normal(contact.normal);
    const double pressing = glm::dot(force, normal);
    body.add(glm::dvec3(positions[node]) - origin,
             {normal, pressing, force - pressing * normal, static_cast<double>(contact.along),
              static_cast<double>(contact.across)});
}

// Nodes that a collider has stopped go back with restitution times the speed they would have had without it.
template <class Real>
void BlockDescent<Real>::finish(Real step, const Nodes<Real>& previous, Nodes<Real>& current) const {
    const auto least = static_cast<Real>(resting_speed(model_->gravity, static_cast<double>(step)));
    for_each_node(*model_, [&](std::uint32_t n) {
        const Vec4<Real> old = previous.velocities[n];
        current.velocities[n] = old;
        if (current.positions[n].w == Real(0)) return;
        const Vec3<Real> position(current.positions[n]), start(objective_.starts[n]);
        Vec3<Real> velocity = (position - start) / step;
        if (contacts_.has_contact(n))
            rebound<Real>(model_->colliders, position, (Vec3<Real>(objective_.targets[n]) - start) / step,
                          least, velocity);
        current.velocities[n] = Vec4<Real>(velocity, old.w);
    });
}

template class BlockDescent<float>;
template class BlockDescent<double>;

}  // namespace gelatin::cpu
