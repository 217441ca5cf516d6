#pragma once

#include <memory>
#include <vector>

#include "cpu/cpu_solver.h"
#include "cpu/explicit/advance_nodes.h"
#include "model/explicit/explicit_scheme.h"

namespace gelatin::cpu {

/// Moves nodes by the passes of an explicit scheme (model/explicit/explicit_scheme.h).
template <class Real>
class ExplicitSolver : public CpuSolver<Real> {
public:
    /// @param solver an explicit one
    ExplicitSolver(std::shared_ptr<const Model> model, SolverKind solver, ForceMethod forces,
                   const CollisionSettings& collision = {});

    ContactForces contact_forces() override { return {}; }
    HoldingForces holding_forces() override { return {}; }
    std::vector<std::uint32_t> held_up(std::span<const glm::dvec3> /*places*/) override { return {}; }

protected:
    void advance_nodes(const Step& step) override;

    using CpuSolver<Real>::model_, CpuSolver<Real>::current_, CpuSolver<Real>::previous_,
        CpuSolver<Real>::load_forces_, CpuSolver<Real>::pulls_;

private:
    void add_pulls(const Nodes<Real>& nodes, Real step);
    void find_volume_stresses(const Nodes<Real>& nodes);
    void run_pass(const Pass<Real>& pass);

    ExplicitScheme scheme_;
    ForceMethod forces_;
    Nodes<Real> stage_[2];  // between the passes of one step
    Nodes<Real> sums_;
    std::vector<Vec4<Real>> spring_forces_, node_forces_;
    TetBlocks pass_tets_;                // in float
    std::vector<Real> volume_stresses_;  // [Pa], shape [nodes]; empty without a volume term
};

}  // namespace gelatin::cpu
