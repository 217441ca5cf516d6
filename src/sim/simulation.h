#pragma once

#include <map>
#include <memory>
#include <optional>
#include <vector>

#include "model/drive/with_pins.h"
#include "sim/simulator_impl.h"
#include "sim/standstills.h"

namespace gelatin {

/// A Simulator that simulates.
struct Simulation final : SimulatorInternals::Impl {
    std::optional<State> start_state;       // if it is not the model's
    std::shared_ptr<const Model> unpinned;  // the model without the pins of programs
    std::vector<AddedPin> pins;
    std::vector<Pull> pulls;
    std::vector<glm::vec3> forces;  // [N], shape [nodes]; empty: none
    MadeAttachments attachments;
    Standstills standstills;

    /// @pre the scene is valid, and the model is what build_model makes of it
    Simulation(const Scene& of, std::shared_ptr<const Model> from, const SimulatorOptions& with);
    /// Another one of the same scene and model, at the start. It repeats no check and no message.
    /// @pre `like` has no OpenGL context and no pins of programs
    Simulation(const Simulation& like);
    Simulation& operator=(const Simulation&) = delete;
    ~Simulation() override = default;

    void step() override;
    void reset() override;
    int steps_a_frame() const override { return clock.substeps(); }
    Simulation& simulation() override { return *this; }
    Playback* playback() override { return nullptr; }
    const MadeAttachments& made_attachments() override { return attachments; }
    std::string attachments_memory() const override { return attachments.memory(scene); }

    State first_state() const;
    /// Continues from this state. Pending measurements belong to the old one.
    void take_state(const State& state, const Moment& moment);
    /// Bodies that never pass through each other have to be apart. @return whether any was moved
    /// @throws InvalidInput if they cannot be moved apart
    bool move_bodies_apart(std::vector<glm::vec4>& positions, const char* when) const;
    /// Gives the solver the attachments. @param had_some whether it had any before
    void set_attachments(bool had_some = true);
    /// @throws InvalidInput if there is none of this number
    void require_attachment(std::size_t attachment) const;
    /// @throws InvalidInput if there is none of this number
    const Cavity& require_cavity(std::size_t cavity) const;
    /// Makes the solver's tables anew, and goes on where it is.
    void rebuild(const Scene& of, std::shared_ptr<const Model> from, std::vector<AddedPin> added);

private:
    BackendSolver make_solver(const Scene& of, const std::shared_ptr<const Model>& from) const;
    void begin();
    struct HeldMotions {
        std::vector<HandleMotion> handles;
        std::vector<NodeMotion> animated;
    };
    HeldMotions move_held_nodes();
    std::vector<MotorTarget> find_motors();
    std::vector<double> find_cavity_drives();
    std::vector<std::uint32_t> find_held_up() const;
    void look_for_standstills();
    void look_for_broken();
    void discard_pending();
    void carry_over_to(const Model& next, const std::vector<AddedPin>& added, State& state, Drags& next_drags,
                       HandleClocks& next_clocks) const;
};

}  // namespace gelatin
