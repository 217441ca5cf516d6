#pragma once

#include <functional>
#include <string>

#include "gelatin/scene.h"
#include "model/scene/field_path.h"

namespace gelatin {

/// Reports what is wrong with a field by throwing InvalidInput.
/// @param value as the scene has it; empty for a table
using ReportProblem =
    std::function<void(const FieldPath& field, const std::string& value, const std::string& problem)>;

/// All that a scene must fulfil, whether it comes from a file or from a program: numbers finite and in range,
/// names there and free, references that resolve, settings that go together. `report` gets the first problem,
/// in the order of sections, materials, objects, colliders and attachments.
void validate(const Scene& scene, const ReportProblem& report);

/// A camera that a program gives. @throws InvalidInput naming "camera"
void check_camera(const CameraDescription& camera);

/// The name of the material, object, collider or attachment that the path starts with; else empty.
std::string name_at(const Scene& scene, const FieldPath& path);

}  // namespace gelatin
