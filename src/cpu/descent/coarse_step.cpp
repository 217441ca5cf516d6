#include "cpu/descent/coarse_step.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <utility>

namespace gelatin::cpu {
namespace {

// Displacements are made longer by no more than this.
constexpr double kFarthest = 2.0;

}  // namespace

template <class Real>
CoarseStep<Real>::CoarseStep(std::shared_ptr<const Model> model)
    : model_(std::move(model)), coarse_(model_) {}

template <class Real>
void CoarseStep<Real>::run(const StepObjective<Real>& objective, const ColliderContacts<Real>& contacts,
                           SecantStep<Real>& secant, std::vector<Vec4<Real>>& positions) {
    const std::vector<Vec3<Real>>& forces = secant.find_forces(objective, contacts, positions);
    coarse_.find_displacements(positions, forces, secant.displacements);
    secant.look_ahead(objective, contacts, positions);
    tbb::parallel_for(std::size_t(0), model_->objects.size(), [&](std::size_t o) {
        if (!coarse_.moves(o)) return;
        // No node goes farther than the object is long.
        const Range& nodes = model_->objects[o].nodes;
        double longest = 0.0;
        for (std::uint32_t n = nodes.first; n < nodes.end(); ++n)
            longest = std::max(longest, static_cast<double>(glm::length(secant.displacements[n])));
        const auto part =
            static_cast<Real>(std::min(secant.part(secant.work(o), kFarthest), coarse_.length(o) / longest));
        if (part > Real(0)) secant.move(o, part, positions);
    });
}

template class CoarseStep<float>;
template class CoarseStep<double>;

}  // namespace gelatin::cpu
