#pragma once

#include <map>
#include <span>
#include <tuple>

#include "cpu/contact/contacts.h"
#include "cpu/descent/collider_contacts.h"
#include "cpu/nodes.h"
#include "model/model.h"
#include "model/solver.h"

namespace gelatin::cpu {

/// The forces of contacts and planes at the end of a step of vertex block descent.
/// @param contacts between objects; null: none @param planes tells which nodes they hold
/// @param forces on each node of all elements but contacts and planes [N], which these balance
template <class Real>
ContactForces find_contact_forces(const Model& model, const Contacts<Real>* contacts,
                                  const ColliderContacts<Real>& planes, std::span<const Vec3<Real>> forces,
                                  std::span<const Vec4<Real>> positions);

}  // namespace gelatin::cpu
