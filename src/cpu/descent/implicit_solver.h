#pragma once

#include <memory>
#include <vector>

#include "cpu/cpu_solver.h"
#include "cpu/descent/block_descent.h"
#include "cpu/descent/match_shapes.h"

namespace gelatin::cpu {

/// Moves nodes by steps of implicit Euler (BlockDescent), which contacts between bodies are part of.
template <class Real>
class ImplicitSolver : public CpuSolver<Real> {
public:
    /// @param device that makes the sweeps of bodies with contacts; null: the host makes them; must outlive
    /// this
    explicit ImplicitSolver(std::shared_ptr<const Model> model, const CollisionSettings& collision = {},
                            const DescentSettings& descent = {}, DeviceSweeps* device = nullptr);

    ContactForces contact_forces() const override { return descent_.contact_forces(current_.positions); }
    HoldingForces holding_forces() const override;
    std::vector<std::uint32_t> held_up(std::span<const HandlePose> poses) const override {
        return descent_.held_up(poses, current_.positions);
    }
    void write_state(const State& state) override;

protected:
    void apply_kinematics(std::span<const HandleMotion> motions) override;
    void advance_nodes(const Step& step) override;

    using CpuSolver<Real>::model_, CpuSolver<Real>::current_, CpuSolver<Real>::previous_,
        CpuSolver<Real>::has_earlier_, CpuSolver<Real>::load_forces_;

private:
    BlockDescent<Real> descent_;
    ShapeMatcher<Real> shape_matcher_;      // of bodies that have lost their shape, before they descend
    double step_ = 0.0;                     // the last one [s]
    std::vector<glm::dvec3> held_changes_;  // of handle nodes' velocities as it began [m/s]
};

}  // namespace gelatin::cpu
