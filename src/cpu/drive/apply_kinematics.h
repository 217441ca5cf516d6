#pragma once

#include <span>

#include "cpu/nodes.h"
#include "model/model.h"

namespace gelatin::cpu {

/// Puts the nodes of handles where a step begins, with the velocities that take them to where it ends: from
/// the handles' motions alone, so that nothing adds up over many steps. Released ones get their mass back,
/// and keep place and velocity. GLSL twin: sim/drive/apply_kinematics.comp.
template <class Real>
void apply_kinematics(const Model& model, std::span<const HandleMotion> motions, Nodes<Real>& nodes);

}  // namespace gelatin::cpu
