#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec4.hpp>
#include <span>
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

std::vector<DescentRow> rows_of(const DescentRows& rows, const Model& model);

/// With kNoNode for nodes of neo-Hookean tets, whose terms come with those.
std::vector<std::uint32_t> rows_of_springs(const Model& model, std::span<const std::uint32_t> rows);

/// The tets round nodes, two in an element {tet, share, tet, share}: the bits of the share that a tet has of
/// the volume there at rest, 0 where a node has no more tets. Of each node, in slices of packing::kSlice
/// nodes.
struct VolumeShares {
    std::vector<std::uint32_t> slice_starts;  ///< shape [slices + 1]
    std::vector<glm::uvec4> pairs;            ///< shape [slice_starts.back()]
};

/// @param node_tets of all tets of the model @pre it has a volume term
VolumeShares volume_shares_of(const Model& model, const NodeTets& node_tets);

/// The tets of each row's node, if it is one of springs.
TetCorners corners_of(const Model& model, std::span<const std::uint32_t> rows);

}  // namespace gelatin::gpu
