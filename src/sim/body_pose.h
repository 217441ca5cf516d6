#pragma once

#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <span>

#include "model/model.h"
#include "model/solver.h"

namespace gelatin {

/// Where a body is, from where the model has it: a rotation about a point, which is then moved.
struct BodyPose {
    glm::dvec3 pivot{0.0}, center{0.0};       ///< the point in the model, and now [m]
    glm::dquat rotation{1.0, 0.0, 0.0, 0.0};  ///< a unit quaternion

    glm::dvec3 place(const glm::dvec3& in_model) const { return center + rotation * (in_model - pivot); }
};

/// The one nearest to where nodes are, in the mean of their masses. @param positions shape [nodes]
BodyPose nearest_pose(const Model& model, const ModelObject& body, std::span<const glm::vec4> positions);
/// The same by nodes of its surface alone.
BodyPose nearest_pose_of_surface(const Model& model, const ModelObject& body,
                                 std::span<const glm::vec4> positions);

/// Puts a rigid body there, with the velocity and the spin that it has.
/// @param displacement of its centre by that [m]
void put_rigid(const Model& model, const ModelObject& body, const BodyPose& pose,
               const glm::dvec3& displacement, State& state);
/// Gives a rigid body's nodes the velocities of its momentum and angular momentum.
void move_rigidly(const ModelObject& body, State& state);

}  // namespace gelatin
