#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "mesh/surface_mesh.h"

namespace gelatin {

constexpr std::uint32_t kNoPiece = ~0u;

/// For each closed piece of a surface, the other ones that contain all of it. A piece may touch its
/// containers in common vertices.
/// @param piece_of_face kNoPiece for faces that are in no closed piece
std::vector<std::vector<std::uint32_t>> find_containers(const SurfaceMesh& mesh,
                                                        std::span<const std::uint32_t> piece_of_face,
                                                        std::uint32_t piece_count);

}  // namespace gelatin
