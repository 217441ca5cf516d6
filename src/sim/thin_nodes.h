#pragma once

#include <cstdint>
#include <vector>

#include "model/model.h"

namespace gelatin {

/// Nodes of the surfaces, evenly spaced at rest: about `count` in all bodies together, at least one in each.
/// Within a body no two are nearer to each other than the spacing, and no other node of its surface is
/// farther than that from all of them.
std::vector<std::uint32_t> thin_surface_nodes(const Model& model, std::size_t count);

}  // namespace gelatin
