#pragma once

#include <nanobind/nanobind.h>

#include "gelatin/scene.h"

namespace gelatin::python {

/// A scene from an instance of gelatin.Scene.
/// @throws nanobind's TypeError for a value of another type; InvalidInput for a word that is not allowed
Scene scene_of(nanobind::handle source);

/// The same for gelatin.Material, gelatin.Camera, gelatin.Attachment, gelatin.JointMotor and regions.
Material material_of(nanobind::handle source);
CameraDescription camera_of(nanobind::handle source);
AttachmentDescription attachment_of(nanobind::handle source);
JointMotor motor_of(nanobind::handle source);
/// @param pressure, amount numbers, or None
CavityGas gas_of(nanobind::handle pressure, nanobind::handle amount);
Region region_of(nanobind::handle source);

/// An instance of gelatin.Scene.
nanobind::object python_scene(const Scene& scene);

/// A list of gelatin.Attachment.
nanobind::object python_attachments(const Scene& scene);

/// By class of the package, what a default-constructed struct of C++ has in its fields.
nanobind::dict scene_defaults();

}  // namespace gelatin::python
