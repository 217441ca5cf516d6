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
    bool sleeps = false;
    std::optional<gpu::PairCapacity> room = {};  ///< at first
};

/// With contacts between bodies and of bodies with themselves.
gpu::ImplicitSolver make_device_solver(const std::shared_ptr<const Model>& model,
                                       const DeviceContacts& contacts = {});

/// Nodes of the first body are anywhere in a tenth of its extent; of a block at the origin, with an edge of
/// 0.3 m.
State scattered(const Model& model);

/// A handle takes one side of a block along and turns it, and the block pushes another one.
std::shared_ptr<const Model> pushed_block();

/// A handle takes a whole block down by `depth` [m] in 0.2 s, but after 0.04 m a pinned block of 0.2 m is in
/// the way. From 0.3 s on it goes up again, and at 0.4 s it is 0.02 m below its start.
std::shared_ptr<const Model> blocked_block(double depth = 0.1);

/// Each program of such steps, and each barrier.
void run_body_contacts();

}  // namespace gelatin::test
