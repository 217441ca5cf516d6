#include "cpu/descent/rigid_move.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <span>
#include <utility>

#include "cpu/descent/rigid_nodes.h"

namespace gelatin::cpu {
namespace {

template <class Real>
void add_contact(const ColliderContact<Real>& contact, const glm::dvec3& r, RigidStep& body) {
    if (contact.along == Real(0)) return;
    const glm::dvec3 force(contact.force), normal(contact.normal);
    const double pressing = glm::dot(force, normal);
    body.add(r, {normal, pressing, force - pressing * normal, static_cast<double>(contact.along),
                 static_cast<double>(contact.across)});
}

}  // namespace

template <class Real>
RigidMove<Real>::RigidMove(std::shared_ptr<const Model> model)
    : model_(std::move(model)), presses_(model_->node_count()), forces_(model_->node_count()) {}

template <class Real>
void RigidMove<Real>::run(std::size_t batch, bool is_last, const StepObjective<Real>& objective,
                          const ColliderContacts<Real>& contacts, const Contacts<Real>* bodies,
                          const PlaneLanding<Real>* landing, const std::vector<Vec4<Real>>& positions,
                          std::span<Vec4<Real>> ends) {
    std::vector<std::uint32_t> moved;
    const Range& objects = objective.rows().batches[batch].objects;
    for (std::uint32_t o = objects.first; o < objects.end(); ++o)
        if (is_moved(o, is_last, contacts, bodies, positions)) moved.push_back(o);
    if (landing != nullptr) find_pressing(batch, objective, contacts, *landing, positions, moved);
    tbb::parallel_for(std::size_t(0), moved.size(), [&](std::size_t k) {
        const std::uint32_t o = moved[k];
        const Range& nodes = model_->objects[o].nodes;
        const std::span<const Vec4<Real>> body_nodes(positions.data() + nodes.first, nodes.count);
        const glm::dvec3 origin(positions[nodes.first]);
        const std::span<const Vec4<Real>> targets(objective.step.targets.data() + nodes.first, nodes.count);
        RigidStep body;
        body.add(sum_rigid_nodes(body_nodes, targets, origin));
        const bool lands = landing != nullptr && landing->lands(o);
        if (contacts.objects[o] != 0 && !lands) {
            for (std::uint32_t n = nodes.first; n < nodes.end(); ++n)
                add_contact(contacts.nodes[n], glm::dvec3(positions[n]) - origin, body);
        }
        move_rigid_nodes(body.solve(origin), ends.subspan(nodes.first, nodes.count));
        if (lands) landing->land(o, objective, forces_, ends);
    });
}

// The last sweep has left nodes outside colliders: bodies that touch one do not move after it.
template <class Real>
bool RigidMove<Real>::is_moved(std::uint32_t object, bool is_last, const ColliderContacts<Real>& contacts,
                               const Contacts<Real>* bodies, const std::vector<Vec4<Real>>& positions) const {
    if (bodies != nullptr && !bodies->list().is_alone_at(object)) return false;
    if (is_last && contacts.objects[object] != 0) return false;
    const Range& nodes = model_->objects[object].nodes;
    const auto first = positions.begin() + nodes.first;
    return std::none_of(first, first + nodes.count, [](const Vec4<Real>& p) { return p.w == Real(0); });
}

// With what bodies that land press planes already, at the nodes that did in the last sweep.
template <class Real>
void RigidMove<Real>::find_pressing(std::size_t batch, const StepObjective<Real>& objective,
                                    const ColliderContacts<Real>& contacts, const PlaneLanding<Real>& landing,
                                    const std::vector<Vec4<Real>>& positions,
                                    std::span<const std::uint32_t> objects) {
    const auto for_nodes = [&](const auto& use) {
        for (const std::uint32_t o : objects) {
            if (!landing.lands(o)) continue;
            const Range& nodes = model_->objects[o].nodes;
            for (std::uint32_t n = nodes.first; n < nodes.end(); ++n) use(o, n);
        }
    };
    bool any = false;
    for_nodes([&](std::uint32_t o, std::uint32_t n) {
        presses_[n] = contacts.objects[o] != 0 && contacts.nodes[n].along > Real(0) ? 1 : 0;
        any |= presses_[n] != 0;
    });
    if (any) objective.find_forces(batch, positions, forces_, presses_);
    // Of a group of nodes all are found where one is wanted.
    for_nodes([&](std::uint32_t, std::uint32_t n) {
        if (std::exchange(presses_[n], std::uint8_t(0)) == 0) forces_[n] = Vec3<Real>(0);
    });
}

template class RigidMove<float>;
template class RigidMove<double>;

}  // namespace gelatin::cpu
