#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "model/assembly/make_animation.h"

namespace gelatin {

struct Body;
struct Model;

/// The nodes that a handle holds, ascending. @param skeleton null: it has a region @param positions of the
/// body's nodes at the start [m]
std::vector<std::uint32_t> nodes_of(const HandleDescription& handle, const BodySkeleton* skeleton,
                                    const std::vector<glm::dvec3>& positions);

/// Adds a body's handles to the model, and its pins, which are handles without keyframes. Their nodes get the
/// inverse mass 0 and velocity 0. A node that is in two of them belongs to the first.
/// @param positions at the start, of the body's nodes, which begin at `first_node` [m]
void append_handles(const Body& body, const std::vector<glm::dvec3>& positions, std::uint32_t first_node,
                    Model& model);

}  // namespace gelatin
