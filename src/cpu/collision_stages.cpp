#include "cpu/collision_stages.h"

#include <utility>

#include "cpu/collision/respond.h"

namespace gelatin::cpu {
namespace {

template <class Real>
BoxMargin<Real> margin_for(const CollisionSettings& settings) {
    if (!settings.proximity_radius) return {};
    return BoxMargin<Real>::for_distance(*settings.proximity_radius);
}

}  // namespace

template <class Real>
CollisionStages<Real>::CollisionStages(std::shared_ptr<const Model> model, const CollisionSettings& settings,
                                       const CollisionPlan& plan)
    : model_(std::move(model)),
      collision_(model_, settings.broad_phase, settings.detection, margin_for<Real>(settings)),
      contact_{settings.friction, settings.restitution} {
    if (plan.self_collisions) self_.emplace(Self{{model_, collision_}, {model_, contact_}});
    if (plan.proximities)
        proximities_.emplace(model_, collision_, *settings.proximity_radius,
                             settings.self_collision.value_or(false));
}

template <class Real>
void CollisionStages<Real>::respond(double step, const Nodes<Real>& previous, Nodes<Real>& current) {
    // An object's own contacts come first: they are computed for the positions at which they were found.
    if (self_) self_->response.run(self_->collision, static_cast<Real>(step), previous, current);
    cpu::respond(*model_, collision_, contact_, static_cast<Real>(step), previous, current);
}

template <class Real>
bool CollisionStages<Real>::collides(std::uint32_t face) const {
    return collision_.collides(face) || (self_ && self_->collision.collides(face));
}

template <class Real>
std::optional<ProximityMeasure> CollisionStages<Real>::measure_proximities() const {
    if (!proximities_) return std::nullopt;
    return proximities_->measure();
}

template class CollisionStages<float>;
template class CollisionStages<double>;

}  // namespace gelatin::cpu
