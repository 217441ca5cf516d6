#include "cpu/descent/coarse_step.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "model/for_each_index.h"

namespace gelatin::cpu {
namespace {

// Displacements are made longer by no more than this.
constexpr double kFarthest = 2.0;

}  // namespace

template <class Real>
CoarseStep<Real>::CoarseStep(std::shared_ptr<const Model> model, const Contacts<Real>* bodies)
    : model_(std::move(model)), bodies_(bodies), coarse_(model_) {
    ahead_.resize(model_->node_count());
    displacements_.resize(model_->node_count());
    forces_ = forces_ahead_ = displacements_;
}

template <class Real>
void CoarseStep<Real>::run(const StepObjective<Real>& objective, const ColliderContacts<Real>& contacts,
                           std::vector<Vec4<Real>>& positions) {
    objective.find_forces(positions, forces_);
    for_each_index(positions.size(), [&](std::size_t n) {
        if (contacts.has_contact(n)) forces_[n] += contacts.nodes[n].force;
    });
    coarse_.find_displacements(positions, forces_, displacements_);
    for_each_index(positions.size(),
                   [&](std::size_t n) { ahead_[n] = positions[n] + Vec4<Real>(displacements_[n], Real(0)); });
    objective.find_forces(ahead_, forces_ahead_);
    for_each_index(positions.size(), [&](std::size_t n) {
        if (!contacts.has_contact(n)) return;
        const ColliderContact<Real>& contact = contacts.nodes[n];
        const Real along = glm::dot(contact.normal, displacements_[n]);
        forces_ahead_[n] += contact.force - contact.across * displacements_[n] -
                            (contact.along - contact.across) * along * contact.normal;
    });
    tbb::parallel_for(std::size_t(0), model_->objects.size(), [&](std::size_t o) {
        if (!coarse_.moves(o)) return;
        const Range& nodes = model_->objects[o].nodes;
        Real factor = displacement_factor(o);
        if (bodies_ != nullptr) factor = bodies_->allowed_part(nodes, positions, displacements_, factor);
        if (factor == Real(0)) return;
        for (std::uint32_t n = nodes.first; n < nodes.end(); ++n)
            positions[n] += Vec4<Real>(factor * displacements_[n], Real(0));
    });
}

// The part of an object's displacements at which the work of the forces along them is zero, by the secant
// through its values here and after them. No node goes farther than the object is long.
template <class Real>
Real CoarseStep<Real>::displacement_factor(std::size_t object) const {
    double here = 0.0, ahead = 0.0, longest = 0.0;  // [J], [m]
    const Range& nodes = model_->objects[object].nodes;
    for (std::uint32_t n = nodes.first; n < nodes.end(); ++n) {
        here += static_cast<double>(glm::dot(forces_[n], displacements_[n]));
        ahead += static_cast<double>(glm::dot(forces_ahead_[n], displacements_[n]));
        longest = std::max(longest, static_cast<double>(glm::length(displacements_[n])));
    }
    if (!(here > 0.0 && std::isfinite(here) && std::isfinite(ahead))) return Real(0);
    const double factor = here / std::max(here - ahead, here / kFarthest);
    return static_cast<Real>(std::min(factor, coarse_.length(object) / longest));
}

template class CoarseStep<float>;
template class CoarseStep<double>;

}  // namespace gelatin::cpu
