#pragma once

#include <span>

#include "cpu/nodes.h"
#include "model/model.h"

namespace gelatin::cpu {

/// Sets the nodes of handles to their positions at the start of a step, with the velocities that take them to
/// those at its end. They follow from the motions of handles and of animated nodes only, so no error
/// accumulates. Released nodes get their mass back, and keep position and velocity. GLSL twin:
/// sim/drive/apply_kinematics.comp.
/// @param animated of the nodes of animated handles, by HandleNode::animated
template <class Real>
void apply_kinematics(const Model& model, std::span<const HandleMotion> motions,
                      std::span<const NodeMotion> animated, Nodes<Real>& nodes);

}  // namespace gelatin::cpu
