#pragma once

#include <memory>
#include <vector>

#include "cpu/descent/collider_contacts.h"
#include "cpu/descent/rigid_motion.h"
#include "cpu/descent/step_objective.h"
#include "cpu/nodes.h"
#include "model/model.h"

namespace gelatin::cpu {

/// A move of block descent: each body that nothing holds makes Newton's step along rigid motions (RigidStep),
/// which keeps its momentum (docs/block-descent.md). GLSL twin: sim/descent/move_bodies.comp.
template <class Real>
class RigidMove {
public:
    explicit RigidMove(std::shared_ptr<const Model> model);

    /// Moves the bodies of a batch. @param is_last whether no sweep follows
    void run(std::size_t batch, bool is_last, const StepObjective<Real>& objective,
             const ColliderContacts<Real>& contacts, std::vector<Vec4<Real>>& positions) const;

private:
    bool is_moved(std::uint32_t object, bool is_last, const ColliderContacts<Real>& contacts,
                  const std::vector<Vec4<Real>>& positions) const;

    std::shared_ptr<const Model> model_;
};

}  // namespace gelatin::cpu
