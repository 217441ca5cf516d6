#pragma once

#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "cpu/implicit/system_solver.h"
#include "gpu/gpu_solver.h"

namespace gelatin {

/// Steps with contacts where the backend is OpenGL: they are made on the host. The device has the nodes after
/// each step, for drawing and measuring.
class SharedSolver : public gpu::GpuSolver {
public:
    SharedSolver(const std::shared_ptr<const Model>& model, const CollisionSettings& collision,
                 const ImplicitSettings& implicit);

    void set_pulls(std::vector<Pull> pulls) override { host_.set_pulls(std::move(pulls)); }
    void move_pull(std::size_t pull, const glm::dvec3& target) override { host_.move_pull(pull, target); }
    void set_forces(std::span<const glm::vec3> forces) override { host_.set_forces(forces); }
    void set_attachments(const std::vector<Attachment>& attachments) override {
        host_.set_attachments(attachments);
    }
    std::vector<AttachmentForce> attachment_forces() override { return host_.attachment_forces(); }
    ContactForces contact_forces() override { return host_.contact_forces(); }
    HoldingForces holding_forces() override { return host_.holding_forces(); }
    std::vector<std::uint32_t> held_up(std::span<const glm::dvec3> places) override {
        return host_.held_up(places);
    }
    State read_state() override { return host_.read_state(); }
    std::string memory() override { return host_.memory(); }
    HostNodes host_nodes() const override { return host_.host_nodes(); }
    void write_state(const State& state) override;
    /// By the host's clock, since it makes the steps.
    StageTimer& stage_timer() override { return host_.stage_timer(); }
    std::string device() const override { return GpuSolver::device() + " and " + host_.device(); }

protected:
    void apply_kinematics(const Step& step) override { host_.apply_kinematics(step); }
    void advance_nodes(const Step& step) override;

private:
    // Its stages are called by this one's.
    struct Host : cpu::SystemSolver<float> {
        using SystemSolver::advance_nodes, SystemSolver::apply_kinematics, SystemSolver::SystemSolver;
    };

    Host host_;
};

}  // namespace gelatin
