#pragma once

#include <array>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <span>

#include "model/model.h"

namespace gelatin {

/// Edges at which faces meet at less than this are drawn smooth [rad]: 40 degrees.
constexpr double kCreaseAngle = 0.7;

/// Appends an object's surface to `surface`. Each corner of its faces becomes part of a surface vertex.
/// Corners of one node share a vertex as long as the faces between them meet at less than `crease_angle` in
/// the rest shape. Where texture coordinates differ, a vertex is split, but its normal is not.
/// @param positions of all nodes at rest, xyz [m]
/// @param faces all faces packed so far; the object's are `range`
/// @param crease_angle between face normals [rad]
/// @param corner_uvs of all faces; none: no textures
void append_draw_surface(std::span<const glm::vec4> positions, std::span<const Face> faces, Range range,
                         double crease_angle, DrawSurface& surface,
                         std::span<const std::array<glm::vec2, 3>> corner_uvs = {});

}  // namespace gelatin
