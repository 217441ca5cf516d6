#pragma once

#include <functional>
#include <string>

#include "mesh/surface_mesh.h"

namespace gelatin {

/// A component of a colour, limited to [0, 1]; 1 if it is not finite.
float color_component(double value);
float linear_of_srgb(float value);

/// Sets the image of a material that has the name of one. If `load` throws an Error, or returns neither a PNG
/// nor a JPEG file, the image is left out, with a line in `notes`.
/// @param load returns its bytes
void load_image(SurfaceMaterial& material, const std::function<std::string()>& load, Notes& notes);

}  // namespace gelatin
