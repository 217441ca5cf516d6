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

template <class Real>
void RigidMove<Real>::run(std::size_t batch, bool is_last, const StepObjective<Real>& objective,
                          const ColliderContacts<Real>& contacts, std::vector<Vec4<Real>>& positions) const {
    const Range& objects = objective.rows().batches[batch].objects;
    tbb::parallel_for(objects.first, objects.end(), [&](std::uint32_t o) {
        if (!is_moved(o, is_last, contacts, positions)) return;
        const Range& nodes = model_->objects[o].nodes;
        const std::span<Vec4<Real>> body_nodes(positions.data() + nodes.first, nodes.count);
        const glm::dvec3 origin(positions[nodes.first]);
        const std::span<const Vec4<Real>> targets(objective.step.targets.data() + nodes.first, nodes.count);
        RigidStep body;
        body.add(sum_rigid_nodes(std::span<const Vec4<Real>>(body_nodes), targets, origin));
        if (contacts.objects[o] != 0) {
            for (std::uint32_t n = nodes.first; n < nodes.end(); ++n)
                add_contact(contacts.nodes[n], glm::dvec3(positions[n]) - origin, body);
        }
        move_rigid_nodes(body.solve(origin), body_nodes);
    });
}

// The last sweep has left nodes outside colliders: bodies that touch one do not move after it.
template <class Real>
bool RigidMove<Real>::is_moved(std::uint32_t object, bool is_last, const ColliderContacts<Real>& contacts,
                               const std::vector<Vec4<Real>>& positions) const {
    if (is_last && contacts.objects[object] != 0) return false;
    const Range& nodes = model_->objects[object].nodes;
    const auto first = positions.begin() + nodes.first;
    return std::none_of(first, first + nodes.count, [](const Vec4<Real>& p) { return p.w == Real(0); });
}

template class RigidMove<float>;
template class RigidMove<double>;

}  // namespace gelatin::cpu
