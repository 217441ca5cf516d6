#pragma once

#include "core/stage.h"
#include "gelatin/scene.h"
#include "model/model.h"

namespace gelatin {

/// Which stages of collision a step has behind its motion of nodes.
struct CollisionPlan {
    bool object_pairs = false;
    bool face_collisions = false;  ///< of other objects
    bool self_collisions = false;
    bool proximities = false;

    bool needs_boxes() const { return face_collisions || self_collisions || proximities; }
    bool has_response() const { return face_collisions || self_collisions; }
};

/// Of a response, as Simulator chooses it. Contacts are a part of how nodes move, not a stage; only
/// proximities are sought with them, or without any response.
CollisionPlan plan_collision(const Model& model, const CollisionSettings& settings);

/// The stages of collision in their order (paper 3.1), the same on both backends.
/// @param stages with a function for each, of the names below
/// @param previous the nodes when the step of `step` seconds began @param current which the response changes
template <class Stages, class Nodes>
void run_collision_stages(const CollisionPlan& plan, Stages& stages, double step, const Nodes& previous,
                          Nodes& current, StageTimer& timer) {
    const auto run = [&](bool is_planned, const char* name, const auto& work) {
        if (!is_planned) return;
        const Stage stage(timer, name);
        work();
    };
    run(plan.needs_boxes(), "update_boxes", [&] { stages.update_boxes(previous, current); });
    run(plan.object_pairs, "find_object_pairs", [&] { stages.find_object_pairs(current); });
    run(plan.face_collisions, "find_face_collisions",
        [&] { stages.find_face_collisions(previous, current); });
    run(plan.self_collisions, "find_self_collisions", [&] { stages.find_self_collisions(current); });
    run(plan.proximities, "find_proximities", [&] { stages.find_proximities(current); });
    run(plan.has_response(), "respond", [&] { stages.respond(step, previous, current); });
}

}  // namespace gelatin
