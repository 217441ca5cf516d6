#pragma once

#include "cpu/collision/collision.h"
#include "cpu/collision/contact.h"

namespace gelatin::cpu {

/// The paper's response to colliding faces (2.4): nodes that approach the other object return to their
/// `previous` positions, along the normal and relative to the contact, and their velocities respond. The
/// momentum of two objects that touch is conserved (docs/collision.md). The same bits for any number of
/// threads. GPU twins: shaders/sim/collision/sum_contacts.comp, plan_responses.comp, respond.comp.
/// @param step from `previous` to `current` [s]
template <class Real>
void respond(const Model& model, const Collision<Real>& collision, const ContactProperties& properties,
             Real step, const Nodes<Real>& previous, Nodes<Real>& current);

}  // namespace gelatin::cpu
