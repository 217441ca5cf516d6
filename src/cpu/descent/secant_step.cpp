#include "cpu/descent/secant_step.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "model/for_each_index.h"

namespace gelatin::cpu {

template <class Real>
SecantStep<Real>::SecantStep(std::shared_ptr<const Model> model)
    : displacements(model->node_count()), model_(std::move(model)), ahead_(displacements.size()) {
    forces_ = forces_ahead_ = displacements;
}

template <class Real>
const std::vector<Vec3<Real>>& SecantStep<Real>::find_forces(const StepObjective<Real>& objective,
                                                             const ColliderContacts<Real>& colliders,
                                                             const std::vector<Vec4<Real>>& positions) {
    objective.find_forces(positions, forces_);
    for_each_index(positions.size(), [&](std::size_t n) {
        if (colliders.has_contact(n)) forces_[n] += colliders.nodes[n].force;
    });
    return forces_;
}

template <class Real>
void SecantStep<Real>::look_ahead(const StepObjective<Real>& objective,
                                  const ColliderContacts<Real>& colliders,
                                  const std::vector<Vec4<Real>>& positions) {
    for_each_index(positions.size(),
                   [&](std::size_t n) { ahead_[n] = positions[n] + Vec4<Real>(displacements[n], Real(0)); });
    objective.find_forces(ahead_, forces_ahead_);
    for_each_index(positions.size(), [&](std::size_t n) {
        if (!colliders.has_contact(n)) return;
        const ColliderContact<Real>& contact = colliders.nodes[n];
        const Real along = glm::dot(contact.normal, displacements[n]);
        forces_ahead_[n] += contact.force - contact.across * displacements[n] -
                            (contact.along - contact.across) * along * contact.normal;
    });
}

template <class Real>
Work SecantStep<Real>::work(std::size_t object) const {
    Work work;
    const Range& nodes = model_->objects[object].nodes;
    for (std::uint32_t n = nodes.first; n < nodes.end(); ++n) {
        work.here += static_cast<double>(glm::dot(forces_[n], displacements[n]));
        work.ahead += static_cast<double>(glm::dot(forces_ahead_[n], displacements[n]));
    }
    return work;
}

template <class Real>
double SecantStep<Real>::part(const Work& work, double most) {
    if (!(work.here > 0.0 && std::isfinite(work.here) && std::isfinite(work.ahead))) return 0.0;
    return work.here / std::max(work.here - work.ahead, work.here / most);
}

template <class Real>
void SecantStep<Real>::move(std::size_t object, Real part, std::vector<Vec4<Real>>& positions) const {
    const Range& nodes = model_->objects[object].nodes;
    for (std::uint32_t n = nodes.first; n < nodes.end(); ++n)
        positions[n] += Vec4<Real>(part * displacements[n], Real(0));
}

template class SecantStep<float>;
template class SecantStep<double>;

}  // namespace gelatin::cpu
