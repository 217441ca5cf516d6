#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "cpu/cpu_solver.h"
#include "cpu/implicit/implicit_step.h"
#include "cpu/implicit/rest_watch.h"
#include "cpu/recovery/match_shapes.h"

namespace gelatin::cpu {

/// Moves nodes by steps that are solved as one linearised system (ImplicitStep).
template <class Real>
class SystemSolver : public CpuSolver<Real> {
public:
    explicit SystemSolver(std::shared_ptr<const Model> model, const CollisionSettings& collision = {},
                          const ImplicitSettings& settings = {});

    ContactForces contact_forces() override { return step_.contact_forces(); }
    void set_attachments(const std::vector<Attachment>& attachments) override;
    std::vector<AttachmentForce> attachment_forces() override { return step_.attachment_forces(current_); }
    /// What contacts and their friction hold [J].
    double contact_energy() const { return step_.contact_energy(); }
    /// What the linear systems of all steps so far have cost.
    const SolveCounts& solve_counts() const { return step_.solve_counts(); }
    HoldingForces holding_forces() override;
    std::vector<std::uint32_t> held_up(std::span<const glm::dvec3> places) override;
    std::string memory() override;
    void write_state(const State& state) override;

protected:
    void apply_kinematics(const Step& step) override;
    void advance_nodes(const Step& step) override;

    using CpuSolver<Real>::model_, CpuSolver<Real>::current_, CpuSolver<Real>::previous_,
        CpuSolver<Real>::has_earlier_, CpuSolver<Real>::load_forces_;

private:
    bool rests(const Step& step);
    void slow_blocked(Real size);
    void archive(Archive& archive);
    void forget();
    bool restore(std::string_view memory);

    bool divides_steps_;
    bool goes_on_ = false;  // with earlier velocities of a state that was written
    ImplicitStep<Real> step_;
    ShapeMatcher<Real> shape_matcher_;  // of bodies that have lost their shape, before they move
    std::optional<RestWatch<Real>> rest_watch_;
    Nodes<Real> from_, to_;  // of a part of a step
    double size_ = 0.0;      // of the last step [s]
    std::vector<Vec3<Real>>
        goals_;  // of held nodes at the end of a step [m], by node; others' are not written
    std::vector<Vec3<Real>> held_at_;       // where held nodes are, if bodies are in their way
    std::vector<glm::dvec3> held_changes_;  // of handle nodes' velocities as a step began [m/s]
    std::vector<glm::dvec3> forces_on_held_;
};

}  // namespace gelatin::cpu
