#pragma once

#include <memory>
#include <optional>

#include "gpu/collision/find_face_collisions.h"
#include "gpu/collision/find_object_pairs.h"
#include "gpu/collision/find_self_collisions.h"
#include "gpu/collision/respond.h"
#include "gpu/collision/respond_to_self.h"
#include "gpu/collision/update_boxes.h"
#include "gpu/depth/cull_by_depth.h"
#include "gpu/proximity/find_proximities.h"

namespace gelatin::gpu {

/// The collision level of a step (paper 3.1): its buffers, and its stages in their order. Nothing waits for
/// the GPU: the results of a stage determine the dispatches of the next.
struct Collision {
    CollisionBuffers buffers;
    UpdateBoxes update_boxes;
    std::unique_ptr<CullByDepth> cull_by_depth;  // with BroadPhase::depth
    FindObjectPairs find_object_pairs;
    FindFaceCollisions find_face_collisions;
    Respond respond;

    /// The same for faces of one object.
    struct Self {
        SelfCollisionBuffers buffers;
        FindSelfCollisions find;
        RespondToSelf respond;
    };
    std::optional<Self> self;

    /// The proximities.
    struct Near {
        ProximityBuffers buffers;
        FindProximities find;
    };
    std::optional<Near> near;

    Collision(const Model& model, const CollisionSettings& settings)
        : buffers(model),
          update_boxes(settings.detection, settings.proximity_radius.value_or(0.0)),
          cull_by_depth(settings.broad_phase == BroadPhase::depth ? std::make_unique<CullByDepth>(model)
                                                                  : nullptr),
          find_object_pairs(model, settings.broad_phase, cull_by_depth.get()),
          find_face_collisions(settings, cull_by_depth.get()),
          respond(model, buffers, settings) {
        if (settings.self_collision.value_or(false)) {
            self.emplace(
                Self{SelfCollisionBuffers(model), FindSelfCollisions(model), RespondToSelf(model, settings)});
        }
        if (settings.proximity_radius) {
            near.emplace(
                Near{ProximityBuffers(model, buffers),
                     FindProximities(*settings.proximity_radius, settings.self_collision.value_or(false))});
        }
    }
};

/// The stages with what they run on, for run_collision_stages.
struct CollisionStages {
    const ModelBuffers& model;
    Collision& collision;

    void update_boxes(const NodeBuffers& previous, const NodeBuffers& current) const {
        collision.update_boxes.run(model, collision.buffers, previous, current);
    }
    void find_object_pairs(const NodeBuffers& current) const {
        collision.find_object_pairs.run(model, collision.buffers, current);
    }
    void find_face_collisions(const NodeBuffers& previous, const NodeBuffers& current) const {
        collision.find_face_collisions.run(model, collision.buffers, previous, current);
    }
    void find_self_collisions(const NodeBuffers& current) const {
        collision.self->find.run(model, collision.buffers, collision.self->buffers, current);
    }
    void find_proximities(const NodeBuffers& current) const {
        collision.near->find.run(model, collision.buffers, collision.near->buffers, current);
    }
    void respond(double step, const NodeBuffers& previous, const NodeBuffers& current) const {
        // An object's own contacts come first: they are computed for the positions at which they were found.
        if (collision.self)
            collision.self->respond.run(model, collision.buffers, collision.self->buffers, previous, current,
                                        step);
        collision.respond.run(model, collision.buffers, previous, current, step);
    }
};

}  // namespace gelatin::gpu
