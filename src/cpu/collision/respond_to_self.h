#pragma once

#include "cpu/collision/find_self_collisions.h"
#include "cpu/collision/self_contact.h"
#include "cpu/nodes.h"

namespace gelatin::cpu {

/// The response to faces of one object that touch one another: as cpu::respond, but face by face, because a
/// body that folds touches itself in several places and directions (docs/collision.md). Momentum is
/// conserved; the same bits for any number of threads. GPU twin: shaders/sim/collision/respond_to_self.comp.
/// @param step from `previous` to `current` [s]
template <class Real>
class RespondToSelf {
public:
    RespondToSelf(std::shared_ptr<const Model> model, const ContactProperties& properties);

    void run(const FindSelfCollisions<Real>& collision, Real step, const Nodes<Real>& previous,
             Nodes<Real>& current);

private:
    std::shared_ptr<const Model> model_;
    ContactProperties properties_;
    std::vector<FaceLump<Real>> lumps_;          // of colliding faces, shape [faces]
    std::vector<LumpResponse<Real>> responses_;  // the same
};

}  // namespace gelatin::cpu
