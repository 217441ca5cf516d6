#pragma once

#include <cstdint>
#include <glm/vec4.hpp>
#include <span>
#include <vector>

#include "model/contact/contact_limits.h"
#include "model/descent/descent_rows.h"
#include "model/layouts.h"

namespace gelatin {

/// What colliders did in the last sweep (cpu::ColliderContacts).
struct DeviceContacts {
    std::vector<ColliderContact> nodes;  ///< shape [nodes]; empty in models without colliders
    std::vector<std::uint32_t> objects;  ///< not 0 where they met a collider in this step, shape [objects]
};

/// The sweeps of block descent on a device, for a solver that makes all other moves on the host where bodies
/// meet.
class DeviceSweeps {
public:
    virtual ~DeviceSweeps() = default;

    /// To be called when a step's targets and starts are known.
    /// @param step [s] @param starts, targets as StepObjective has them, shape [nodes]
    virtual void begin(double step, std::span<const glm::vec4> starts,
                       std::span<const glm::vec4> targets) = 0;

    /// Starts sweeps, and does not wait for them.
    /// @param update of tets, before them
    /// @param positions [m], shape [nodes]
    virtual void start(int sweeps, TetUpdate update, const ContactLimits& limits,
                       std::span<const glm::vec4> positions) = 0;
    /// Starts all moves of a step in which nothing meets, and does not wait for them: sweeps, rigid motions
    /// and coarse corrections. @param positions [m], shape [nodes]
    virtual void start_apart(int sweeps, std::span<const glm::vec4> positions) = 0;
    /// Waits for what was started. @param positions output [m], shape [nodes]
    virtual void finish(std::span<glm::vec4> positions, DeviceContacts& contacts) = 0;
};

}  // namespace gelatin
