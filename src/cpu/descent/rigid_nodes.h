#pragma once

#include <span>

#include "cpu/descent/rigid_motion.h"
#include "cpu/nodes.h"

namespace gelatin::cpu {

/// RigidSums of free nodes; in float with SIMD for the processor it runs on.
/// @param targets y [m], m / h^2 [N/m], shape [nodes]
RigidSums sum_rigid_nodes(std::span<const glm::vec4> positions, std::span<const glm::vec4> targets,
                          const glm::dvec3& origin);
RigidSums sum_rigid_nodes(std::span<const glm::dvec4> positions, std::span<const glm::dvec4> targets,
                          const glm::dvec3& origin);

/// Moves nodes as the motion says, in float with SIMD; their fourth components stay as they are.
void move_rigid_nodes(const RigidMotion& motion, std::span<glm::vec4> positions);
void move_rigid_nodes(const RigidMotion& motion, std::span<glm::dvec4> positions);

}  // namespace gelatin::cpu
