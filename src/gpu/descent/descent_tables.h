#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec4.hpp>
#include <vector>

#include "model/descent/descent_rows.h"
#include "model/elasticity/node_tets.h"
#include "model/model.h"

/// What the shaders of sim/descent/ read of a model, packed as their buffers have it.
namespace gelatin::gpu {

/// Of each tet the volume at rest [m^3], the modulus [Pa] and the stiffness of the volume term [Pa].
std::vector<glm::vec4> rests_of(const Model& model);

/// Of each pair of half springs the nodes at their other ends.
std::vector<glm::uvec2> ends_of(const HalfSprings& springs);

/// Of each pair of half springs rest length [m] and stiffness [N/m], of one and of the other.
std::vector<glm::vec4> springs_of(const HalfSprings& springs);

/// @param objects of nodes
std::vector<DescentRow> rows_of(const DescentRows& rows, const std::vector<std::uint32_t>& objects);

/// The tets of each row's node. Nodes of neo-Hookean tets have none: their terms come with those.
TetCorners corners_of(const Model& model, std::vector<std::uint32_t> rows);

}  // namespace gelatin::gpu
