#include "model/collision/collision_stages.h"

namespace gelatin {

CollisionPlan plan_collision(const Model& model, const CollisionSettings& settings) {
    const bool responds = settings.response == CollisionResponse::restore;
    const bool has_others = model.objects.size() > 1, meets_itself = settings.self_collision.value_or(false);
    CollisionPlan plan;
    plan.face_collisions = responds && has_others;
    plan.self_collisions = responds && meets_itself;
    plan.proximities = settings.proximity_radius && (has_others || meets_itself);
    plan.object_pairs = plan.face_collisions || (plan.proximities && has_others);
    return plan;
}

}  // namespace gelatin
