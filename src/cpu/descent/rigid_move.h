#pragma once

#include <memory>
#include <span>
#include <vector>

#include "cpu/contact/contacts.h"
#include "cpu/descent/collider_contacts.h"
#include "cpu/descent/plane_landing.h"
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
    /// @param bodies whose contacts move those that are not alone (JointMove); null: none
    /// @param landing null: each node by itself is put outside of planes, by sweeps
    /// @param ends output: where the nodes of those that move go; may be the positions themselves
    void run(std::size_t batch, bool is_last, const StepObjective<Real>& objective,
             const ColliderContacts<Real>& contacts, const Contacts<Real>* bodies,
             const PlaneLanding<Real>* landing, const std::vector<Vec4<Real>>& positions,
             std::span<Vec4<Real>> ends);

private:
    bool is_moved(std::uint32_t object, bool is_last, const ColliderContacts<Real>& contacts,
                  const Contacts<Real>* bodies, const std::vector<Vec4<Real>>& positions) const;
    void find_pressing(std::size_t batch, const StepObjective<Real>& objective,
                       const ColliderContacts<Real>& contacts, const PlaneLanding<Real>& landing,
                       const std::vector<Vec4<Real>>& positions, std::span<const std::uint32_t> objects);

    std::shared_ptr<const Model> model_;
    std::vector<std::uint8_t> presses_;  // by node; 0 between runs
    std::vector<Vec3<Real>> forces_;     // on those nodes, but for what planes do [N]; 0 on others of a body
};

}  // namespace gelatin::cpu
