#pragma once

#include <memory>
#include <span>
#include <vector>

#include "cpu/contact/contacts.h"
#include "cpu/descent/collider_contacts.h"
#include "cpu/descent/plane_landing.h"
#include "cpu/descent/step_objective.h"
#include "cpu/nodes.h"
#include "model/model.h"

namespace gelatin::cpu {

/// A move of block descent: the bodies of each island of contacts make a Newton step along rigid motions
/// together, with the contacts between them (docs/contact.md). Each by itself would be thrown back and forth
/// between its neighbours. Bodies that are alone are left to RigidMove.
template <class Real>
class JointMove {
public:
    explicit JointMove(std::shared_ptr<const Model> model);

    /// Finds where the nodes would go. @param is_last whether no sweep follows
    /// @param ends output: of the bodies that move; others' are left as they are
    void run(bool is_last, const Contacts<Real>& contacts, const StepObjective<Real>& objective,
             const ColliderContacts<Real>& colliders, const PlaneLanding<Real>& landing,
             std::span<const Vec4<Real>> positions, std::span<Vec4<Real>> ends) const;

private:
    std::shared_ptr<const Model> model_;
};

}  // namespace gelatin::cpu
