#pragma once

#include <memory>
#include <optional>

#include "cpu/collision/collision.h"
#include "cpu/collision/contact.h"
#include "cpu/collision/find_self_collisions.h"
#include "cpu/collision/respond_to_self.h"
#include "cpu/nodes.h"
#include "cpu/proximity/find_proximities.h"
#include "model/collision/collision_stages.h"
#include "model/solver.h"

namespace gelatin::cpu {

/// The stages of collision on the processor, for run_collision_stages.
template <class Real>
class CollisionStages {
public:
    CollisionStages(std::shared_ptr<const Model> model, const CollisionSettings& settings,
                    const CollisionPlan& plan);

    void update_boxes(const Nodes<Real>& previous, const Nodes<Real>& current) {
        collision_.update_boxes(current.positions, previous.positions);
    }
    void find_object_pairs(const Nodes<Real>& /*current*/) { collision_.find_object_pairs(); }
    void find_face_collisions(const Nodes<Real>& previous, const Nodes<Real>& current) {
        collision_.find_face_collisions(current.positions, previous.positions);
    }
    void find_self_collisions(const Nodes<Real>& current) { self_->collision.run(current.positions); }
    void find_proximities(const Nodes<Real>& current) { proximities_->run(current.positions); }
    void respond(double step, const Nodes<Real>& previous, Nodes<Real>& current);

    /// Of faces and objects, as the last stages have found them.
    const Collision<Real>& collision() const { return collision_; }
    /// True if a face touches another object, or another part of its own.
    bool collides(std::uint32_t face) const;
    /// Empty if none are sought.
    std::optional<ProximityMeasure> measure_proximities() const;

private:
    std::shared_ptr<const Model> model_;
    Collision<Real> collision_;
    ContactProperties contact_;
    struct Self {
        FindSelfCollisions<Real> collision;
        RespondToSelf<Real> response;
    };
    std::optional<Self> self_;
    std::optional<FindProximities<Real>> proximities_;
};

}  // namespace gelatin::cpu
