#pragma once

#include <map>
#include <span>
#include <string>

#include "gelatin/scene.h"

namespace gelatin {

/// The joints of a file of Universal Scene Description, as prims of UsdPhysics, at the start of the scene:
/// fixed, spherical, revolute, prismatic and distance joints, a general one for a universal joint; with
/// limits, drives and the force at which they break.
/// @param paths of the prims of rigid sides, by name. Attachments of others are left out: they are no joints
///     there. Those to nothing are to the world
/// @return empty without any
std::string usd_joints(std::span<const AttachmentDescription> attachments,
                       const std::map<std::string, std::string>& paths);

}  // namespace gelatin
