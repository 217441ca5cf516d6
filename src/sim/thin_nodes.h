#pragma once

#include <cstdint>
#include <vector>

#include "model/model.h"

namespace gelatin {

/// Nodes of the surfaces, evenly spaced at rest: about `count` of all bodies together, at least one of each.
/// Within a body no two are nearer to one another than the spacing, and no other node of its surface is
/// farther from all of them.
std::vector<std::uint32_t> thin_surface_nodes(const Model& model, std::size_t count);

}  // namespace gelatin
