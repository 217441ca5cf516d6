#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "gl/readback.h"
#include "gpu/gpu_solver.h"
#include "gpu/implicit/body_contacts.h"
#include "gpu/implicit/held_forces.h"
#include "gpu/implicit/part_end.h"
#include "gpu/implicit/part_start.h"
#include "gpu/implicit/step_state.h"
#include "gpu/implicit/step_system.h"
#include "gpu/recovery/match_shapes.h"
#include "model/contact/contact_surface.h"

namespace gelatin::gpu {

/// Makes implicit steps, with contacts between bodies where there may be any.
///
/// A step is made in parts, and a part may take several tries (PartEnd). How many it takes the device alone
/// knows, so the host launches as many as the step before has needed. What is left of a step after these is
/// made before anybody reads nodes, or the next step begins: until then a picture shows bodies that are late
/// by so much. CPU twin: cpu::SystemSolver.
class ImplicitSolver : public GpuSolver {
public:
    /// @param room for pairs of surfaces at first, by default for usual cases; it grows
    explicit ImplicitSolver(std::shared_ptr<const Model> model, const CollisionSettings& collision = {},
                            const ImplicitSettings& settings = {},
                            const std::optional<PairCapacity>& room = {});

    ContactForces contact_forces() override;
    HoldingForces holding_forces() override;
    std::vector<std::uint32_t> held_up(std::span<const glm::dvec3> places) override;
    std::string memory() override;
    void write_state(const State& state) override;

protected:
    void complete() override;
    void advance_nodes(const Step& step) override;

private:
    void match_shapes(double elapsed);
    bool is_driven(const Step& step);
    void make_tries();
    void make_try();
    void grow(const PairCapacity& capacity);
    bool restore(std::string_view bytes);

    bool divides_steps_, sleeps_;
    ContactSurface surface_;
    StepState state_;
    StepSystem system_;
    std::optional<BodyContacts> contacts_;  // between bodies
    PartStart start_;
    PartEnd end_;
    std::optional<HeldForces> held_forces_;  // if bodies are held
    ShapeMatcher shape_matcher_;             // of bodies that have lost their shape, before they move
    const SumLoads* loads_ = nullptr;
    bool goes_on_ = false;             // with earlier velocities of a state that was written
    bool is_next_ = false;             // state_ has nodes where the last step ended
    double size_ = 0.0;                // of the last step; 0: none was made since nodes were set [s]
    std::vector<float> load_factors_;  // of the last step
    std::uint32_t tries_ = 1;          // to launch
    bool has_warned_ = false;          // of contacts without a place
    bool may_be_lost_ = false;         // by the step before: a body has lost its shape
    gl::Readback clocks_;              // of steps that were launched: of one at most
    gl::Readback lost_for_;            // the same, with contacts
};

}  // namespace gelatin::gpu
