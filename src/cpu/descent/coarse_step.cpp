#include "cpu/descent/coarse_step.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "model/for_each_index.h"

namespace gelatin::cpu {
namespace {

// Ways are made longer by no more than this.
constexpr double kFarthest = 2.0;

}  // namespace

template <class Real>
CoarseStep<Real>::CoarseStep(std::shared_ptr<const Model> model) : model_(std::move(model)), coarse_(model_) {
    ahead_.resize(model_->node_count());
    ways_.resize(model_->node_count());
    forces_ = forces_ahead_ = ways_;
}

template <class Real>
void CoarseStep<Real>::run(const StepObjective<Real>& objective, const NodeTouches<Real>& touches,
                           std::vector<Vec4<Real>>& positions) {
    objective.find_forces(positions, forces_);
    for_each_index(positions.size(), [&](std::size_t n) {
        if (touches.is_touched(n)) forces_[n] += touches.nodes[n].force;
    });
    coarse_.find_ways(positions, forces_, ways_);
    for_each_index(positions.size(),
                   [&](std::size_t n) { ahead_[n] = positions[n] + Vec4<Real>(ways_[n], Real(0)); });
    objective.find_forces(ahead_, forces_ahead_);
    for_each_index(positions.size(), [&](std::size_t n) {
        if (!touches.is_touched(n)) return;
        const NodeTouch<Real>& touch = touches.nodes[n];
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
Real CoarseStep<Real>::way_factor(std::size_t object) const {
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

template class CoarseStep<float>;
template class CoarseStep<double>;

}  // namespace gelatin::cpu
