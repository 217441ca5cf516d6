#pragma once

#include <deque>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "gelatin/simulator.h"
#include "gl/context.h"
#include "gl/host_state.h"
#include "model/drive/drags.h"
#include "model/drive/handle_arms.h"
#include "model/drive/handle_clocks.h"
#include "sim/backend_solver.h"
#include "sim/checkpoint.h"
#include "sim/draw_source.h"
#include "sim/made_attachments.h"
#include "sim/overlay_source.h"
#include "sim/run_clock.h"
#include "sim/simulator_internals.h"
#include "sim/watch.h"

namespace gelatin {

struct Playback;
struct Simulation;

/// What Simulator's spans of a state refer to, where the solver has none on the host.
struct StateCopies {
    std::optional<std::uint64_t> nodes_revision, forces_revision;  // of the state that they are of
    std::vector<glm::vec4> positions, velocities, contact_forces;
    std::vector<glm::uvec3> faces;  // of the model
};

/// What belongs to a measurement that the solver has begun.
struct PendingStatistics {
    Moment moment;
    std::optional<std::size_t> contacts;  // of colliders; empty: its solver finds no forces
    std::vector<ContactForce> contact_forces;
    std::vector<HoldingForce> holding_forces;
    std::vector<AttachmentStatus> attachments;
    std::vector<CavityStatus> cavities;
};

/// All that a Simulator owns, whether it simulates (Simulation) or plays a recording (Playback).
struct Simulator::Impl {
    Scene scene;  // with the response that its solver has
    SimulatorOptions options;
    std::optional<gl::Context> context;  // declared before everything that owns GL objects
    std::shared_ptr<const Model> model;
    BackendSolver solver;
    std::optional<DrawSource> draw_source;
    std::optional<OverlaySource> overlay_source;
    StepCallback before, after;

    RunClock clock;
    Drags drags;
    HandleClocks handle_clocks;
    HandleArms arms;
    std::optional<Watch> watch;
    std::uint64_t revision = 0;                   // of the state
    std::map<std::size_t, CavityGas> cavity_gas;  // that programs have set, by cavity
    std::map<std::size_t, JointMotor> motors;     // that programs have set, by attachment
    mutable StateCopies copies;
    std::deque<PendingStatistics> pending;
    std::uint32_t reported_losses = 0;
    bool lost_proximities = false;  // and reported

    Impl(const Scene& of, std::shared_ptr<const Model> from, const SimulatorOptions& with, int substeps);
    Impl(const Impl&) = delete;
    Impl& operator=(const Impl&) = delete;
    /// Its OpenGL objects are deleted in its own context.
    virtual ~Impl();

    virtual void step() = 0;
    virtual void reset() = 0;
    virtual int steps_a_frame() const = 0;
    /// For what changes a run. @throws InvalidInput if a recording is played
    virtual Simulation& simulation() = 0;
    virtual const MadeAttachments& made_attachments() = 0;
    /// Of these.
    virtual std::string attachments_memory() const = 0;
    /// Of attachments and bones.
    std::vector<OverlayLine> overlay_lines(const Overlays& overlays);
    /// Null: it simulates.
    virtual Playback* playback() = 0;

    /// Keeps the state of OpenGL of an application whose context this uses, while the result lives. Null
    /// where nothing has to be kept.
    std::unique_ptr<gl::HostState> keep_host_state() const {
        return options.use_current_context ? std::make_unique<gl::HostState>() : nullptr;
    }
    /// The same for what the solver does: on the CPU it makes no OpenGL call.
    std::unique_ptr<gl::HostState> keep_host_state_of_solver() const {
        return solver.uses_gl() ? keep_host_state() : nullptr;
    }

    bool has_contact_forces() const { return scene.has_contact(); }
    /// @throws InvalidInput if there is no such body
    const ModelObject& body(std::size_t object) const;
    double time_of(std::size_t handle) const;  // its own at present [s]
    HandlePose pose_of(std::size_t handle) const;
    const StateCopies& copied_state() const;
    Checkpoint checkpoint() const;
    std::vector<CavityStatus> cavity_states() const;
    /// As Cavity::drive_at.
    double cavity_drive(std::size_t cavity, double time) const;
    /// What programs have set and attached, from Checkpoint::programmed.
    struct Programmed {
        HandleArms arms;
        std::map<std::size_t, JointMotor> motors;
        std::string attachments;  // MadeAttachments::memory
        std::map<std::size_t, CavityGas> cavity_gas;
    };
    /// @throws InvalidInput naming the file, if it does not fit
    Programmed programmed_of(const Checkpoint& checkpoint, const std::filesystem::path& file) const;
    Moment moment_of(const Checkpoint& checkpoint) const;
    void warn_of_losses(const Measurement& measured);
    std::vector<AttachmentStatus> attachment_states() const;
};

}  // namespace gelatin
