#pragma once

#include <glm/vec4.hpp>
#include <span>
#include <string>
#include <vector>

#include "gelatin/scene.h"
#include "model/drive/attachment.h"
#include "model/model.h"

namespace gelatin {

/// Finds the points of an attachment and what carries them: tets of bodies, and of colliders, which are
/// rigid, four nodes as far apart as possible. The same for any number of threads.
/// @param scene valid; the one of the model
/// @param index of the attachment, for its name
/// @param positions of all nodes [m]
/// @throws InvalidInput if no node of the object is there, or a point is too far from what should carry it
Attachment make_attachment(const AttachmentDescription& description, std::size_t index, const Scene& scene,
                           const Model& model, std::span<const glm::vec4> positions);

/// Its own, or by its place in the scene: "attachment 1".
std::string name_of_attachment(const AttachmentDescription& description, std::size_t index);

/// Of its joint: of what its coordinate is in the scene, for 1 in the model, where angles are in radians.
double unit_of_coordinate(const AttachmentDescription& description);

/// What the motor does in a step that begins then [s].
MotorTarget motor_at(const AttachmentDescription& description, const JointMotor& motor, double time);

/// Rigid bodies that attachments join to each other or to colliders, but for those at a distance.
JoinedBodies joined_bodies(const Scene& scene, const Model& model);

/// Those of the scene. @throws InvalidInput as make_attachment
std::vector<Attachment> make_attachments(const Scene& scene, const Model& model,
                                         std::span<const glm::vec4> positions);

}  // namespace gelatin
