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
RigidMove<Real>::RigidMove(std::shared_ptr<const Model> model) : model_(std::move(model)) {}

// The last sweep has left nodes outside colliders: bodies that touch one do not move after it.
template <class Real>
void RigidMove<Real>::run(const Range& objects, bool is_last, const StepObjective<Real>& objective,
                          const ColliderContacts<Real>& contacts, const Contacts<Real>* bodies,
                          const PlaneLanding<Real>* landing, const std::vector<Vec4<Real>>& positions,
                          std::span<Vec4<Real>> ends) const {
    tbb::parallel_for(objects.first, objects.end(), [&](std::uint32_t o) {
        if (bodies != nullptr && !bodies->list().is_alone_at(o)) return;
        const Range& nodes = model_->objects[o].nodes;
        const std::span<const Vec4<Real>> body_nodes(positions.data() + nodes.first, nodes.count);
        const bool is_held = std::any_of(body_nodes.begin(), body_nodes.end(),
                                         [](const Vec4<Real>& p) { return p.w == Real(0); });
        if (is_held || (is_last && contacts.objects[o] != 0)) return;
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
        if (lands) landing->land(o, objective, ends);
    });
}

template class RigidMove<float>;
template class RigidMove<double>;

}  // namespace gelatin::cpu
