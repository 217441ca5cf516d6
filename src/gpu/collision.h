#pragma once

#include "gpu/find_face_collisions.h"
#include "gpu/find_object_pairs.h"
#include "gpu/respond.h"
#include "gpu/update_boxes.h"

namespace gelatin::gpu {

/// The collision level of a step (paper 3.1): its buffers, and its stages in their order. Nothing waits for
/// the GPU: what a stage finds drives the dispatches of the next.
struct Collision {
    CollisionBuffers buffers;
    UpdateBoxes update_boxes;
    FindObjectPairs find_object_pairs;
    FindFaceCollisions find_face_collisions;
    Respond respond;

    /// @pre the model has at least two objects
    Collision(const Model& model, const CollisionSettings& settings)
        : buffers(model),
          update_boxes(settings.detection),
          find_object_pairs(model, settings.broad_phase),
          find_face_collisions(settings),
          respond(buffers, settings) {}
};

}  // namespace gelatin::gpu
