#include "cpu/descent/node_sweep.h"

#include <utility>

#include "cpu/descent/push_outside.h"
#include "model/for_each_index.h"

namespace gelatin::cpu {

template <class Real>
NodeSweep<Real>::NodeSweep(std::shared_ptr<const Model> model) : model_(std::move(model)) {}

template <class Real>
void NodeSweep<Real>::run(std::size_t batch, const StepObjective<Real>& objective,
                          ColliderContacts<Real>& contacts, std::vector<Vec4<Real>>& positions) const {
    const DescentRows& rows = objective.rows();
    const DescentBatch& own = rows.batches[batch];
    const bool any_flat = objective.any_flat_tets(batch);
    const bool any_contact = contacts.has_contact(own.objects);  // in an earlier sweep
    const auto stop_group = [&](std::size_t group, std::uint32_t near_colliders,
                                const typename StepObjective<Real>::Terms& terms) {
        if (contacts.nodes.empty() || (near_colliders == 0 && !any_contact)) return;
        for (std::uint32_t r = 0; r < kGroup; ++r) {
            const std::uint32_t node = rows.nodes[group * kGroup + r];
            if (node == kNoNode) continue;
            if ((near_colliders >> r & 1u) != 0) {
                stop_at_colliders(node, objective, terms.row(r).hessian, contacts, positions[node]);
            } else if (any_contact) {
                contacts.nodes[node] = {};
            }
        }
    };
    const auto move_group = [&](std::size_t group) {
        typename StepObjective<Real>::Terms terms;
        stop_group(group, objective.descend(group, any_flat, positions, terms), terms);
    };
    for (const Range& color : own.colors)
        for_each_index(color.first / kGroup, color.end() / kGroup, kGroupsATask, move_group);
}

template <class Real>
void NodeSweep<Real>::stop_at_colliders(std::uint32_t node, const StepObjective<Real>& objective,
                                        const SymmetricMatrix<Real>& hessian,
                                        ColliderContacts<Real>& contacts, Vec4<Real>& position) const {
    const Vec3<Real> start(objective.step.starts[node]);
    Vec3<Real> moved(position);
    ColliderContact<Real> contact;
    for (const Collider& collider : model_->colliders) {
        if (push_outside(collider, start, hessian, moved, contact)) contacts.mark(node);
    }
    position = Vec4<Real>(moved, position.w);
    if (contact.along > Real(0) || contacts.nodes[node].along > Real(0)) contacts.nodes[node] = contact;
}

template class NodeSweep<float>;
template class NodeSweep<double>;

}  // namespace gelatin::cpu
