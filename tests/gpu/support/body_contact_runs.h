#pragma once

#include <memory>
#include <optional>

#include "gpu/implicit/implicit_solver.h"
#include "model/model.h"

namespace gelatin::test {

struct DeviceContacts {
    double friction = 0.4;
    int iterations = 10;
    bool divides_steps = true;
    std::optional<gpu::PairCapacity> room = {};  ///< at first
};

/// With contacts between bodies and of bodies with themselves.
gpu::ImplicitSolver make_device_solver(const std::shared_ptr<const Model>& model,
                                       const DeviceContacts& contacts = {});

/// Nodes of the first body are anywhere in a tenth of its extent; of a block at the origin, with an edge of
/// 0.3 m.
State scattered(const Model& model);

/// Each program of such steps, and each barrier.
void run_body_contacts();

}  // namespace gelatin::test
