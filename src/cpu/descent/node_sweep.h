#pragma once

#include <memory>
#include <vector>

#include "cpu/descent/collider_contacts.h"
#include "cpu/descent/step_objective.h"
#include "cpu/nodes.h"
#include "model/model.h"

namespace gelatin::cpu {

/// A move of block descent: each node makes one Newton step on its own three coordinates, all nodes of one
/// colour at once, and colliders stop it (cpu/descent/push_outside.h). GPU twin: sim/descent/descend.comp.
template <class Real>
class NodeSweep {
public:
    explicit NodeSweep(std::shared_ptr<const Model> model);

    /// Moves the nodes of a batch of the objective's rows.
    /// @param contacts output: what colliders did to them
    void run(std::size_t batch, const StepObjective<Real>& objective, ColliderContacts<Real>& contacts,
             std::vector<Vec4<Real>>& positions) const;

private:
    void stop_at_colliders(std::uint32_t node, const StepObjective<Real>& objective,
                           const SymmetricMatrix<Real>& hessian, ColliderContacts<Real>& contacts,
                           Vec4<Real>& position) const;

    std::shared_ptr<const Model> model_;
};

}  // namespace gelatin::cpu
