#pragma once

#include <memory>

#include "cpu/cpu_solver.h"
#include "cpu/descent/block_descent.h"
#include "cpu/descent/match_shapes.h"

namespace gelatin::cpu {

/// Moves nodes by steps of implicit Euler (BlockDescent), in which bodies do not meet: what
/// gpu::ImplicitSolver does, as its oracle.
template <class Real>
class ImplicitSolver : public CpuSolver<Real> {
public:
    explicit ImplicitSolver(std::shared_ptr<const Model> model, const CollisionSettings& collision = {},
                            const DescentSettings& descent = {});

    ContactForces contact_forces() const override { return {}; }
    HoldingForces holding_forces() const override { return {}; }
    std::vector<std::uint32_t> held_up(std::span<const HandlePose>) const override { return {}; }
    void write_state(const State& state) override;

protected:
    void advance_nodes(const Step& step) override;

    using CpuSolver<Real>::model_, CpuSolver<Real>::current_, CpuSolver<Real>::previous_,
        CpuSolver<Real>::has_earlier_, CpuSolver<Real>::load_forces_;

private:
    BlockDescent<Real> descent_;
    ShapeMatcher<Real> shape_matcher_;  // of bodies that have lost their shape, before they descend
};

}  // namespace gelatin::cpu
