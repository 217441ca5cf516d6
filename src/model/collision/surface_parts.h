#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/vec4.hpp>
#include <span>

#include "model/model.h"

namespace gelatin {

/// @param around the same faces by node
SurfaceParts make_surface_parts(std::span<const Face> faces, const NodeFaces& around);

/// The median length of the edges of an object's surface [m]; 0 without any.
/// @param positions of all nodes [m]
double median_edge(const Model& model, std::size_t object, std::span<const glm::vec4> positions);

}  // namespace gelatin
