#pragma once

#include <span>

#include "gl/program.h"
#include "gpu/descent/descent_moves.h"
#include "gpu/model_buffers.h"
#include "gpu/node_buffers.h"
#include "model/descent/device_sweeps.h"
#include "model/model.h"
#include "model/solver.h"

namespace gelatin::gpu {

/// Sweeps of block descent that contacts take part in and limit: shaders/sim/descent/descend.comp with
/// CONTACT. CPU twin: cpu::NodeSweep. And all moves of steps in which nothing meets (DescentMoves).
class LimitedSweeps : public DeviceSweeps {
public:
    /// @param buffers of the model, which must outlive this
    LimitedSweeps(const Model& model, const ModelBuffers& buffers, const DescentSettings& settings);

    void begin(double step, std::span<const glm::vec4> starts, std::span<const glm::vec4> targets) override;
    void start(int sweeps, TetUpdate update, const ContactLimits& limits,
               std::span<const glm::vec4> positions) override;
    void start_apart(int sweeps, std::span<const glm::vec4> positions) override;
    void finish(std::span<glm::vec4> positions, DeviceContacts& contacts) override;

private:
    const ModelBuffers& buffers_;
    gl::Program program_;
    DescentMoves moves_;
    NodeBuffers starts_;  // for the damping times in its velocities alone
    NodeBuffers nodes_;
    double step_ = 0.0;  // [s]
    gl::Buffer<NodeLimits> limits_;
    gl::Buffer<glm::vec4> planes_;  // these two grow
    gl::Buffer<NodeShare> shares_;
};

}  // namespace gelatin::gpu
