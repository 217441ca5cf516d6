#pragma once

#include <algorithm>
#include <cstdint>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "core/archive.h"
#include "core/stage_timer.h"
#include "cpu/drive/pulls.h"
#include "cpu/implicit/attachment_rows.h"
#include "cpu/implicit/contact_rows.h"
#include "cpu/implicit/energy_account.h"
#include "cpu/implicit/find_pairs.h"
#include "cpu/implicit/guard.h"
#include "cpu/implicit/islands.h"
#include "cpu/implicit/paces.h"
#include "cpu/implicit/rest_watch.h"
#include "cpu/implicit/restitution.h"
#include "cpu/implicit/rigid_bodies.h"
#include "cpu/implicit/step_system.h"
#include "cpu/implicit/time_scheme.h"
#include "cpu/nodes.h"
#include "gelatin/scene.h"
#include "model/contact/contact_surface.h"
#include "model/model.h"
#include "model/solver.h"

namespace gelatin::cpu {

/// What a step is made with.
template <class Real>
struct StepInput {
    Real step;                                     ///< h [s]
    Real divided;                                  ///< of which it is a part, or 0: it is whole [s]
    std::span<const Vec4<Real>> load_forces = {};  ///< [N], shape [nodes], or empty
    const Pulls<Real>* pulls = nullptr;            ///< null: no hand holds anything
    std::span<const MotorTarget> motors = {};      ///< of attachments, or empty
    /// Whose sleeping bodies are held until something comes near them; null: none sleeps.
    RestWatch<Real>* rest_watch = nullptr;
};

/// One implicit step of all bodies with their contacts: predict, detect, linearise, solve, finish.
template <class Real>
class ImplicitStep {
public:
    /// @param contacts whether bodies meet others; planes always count @param own whether they meet
    /// themselves
    /// @param iterations as ImplicitSettings has it
    ImplicitStep(std::shared_ptr<const Model> model, const CollisionSettings& collision, bool contacts,
                 bool own, int iterations);

    /// Forgets earlier steps, because nodes were set from outside.
    void restart();
    /// After it. @param nodes where the next step begins @param earlier_velocities and step of the last one
    void archive(Archive& archive);
    void go_on(const Nodes<Real>& nodes, std::span<const Vec4<Real>> earlier_velocities, Real step);
    /// @param previous of held nodes the positions are those where they are, and velocities those that take
    /// them to where their handles have them at the end
    /// @param shortest a step may be [s] @param previous bodies that are woken are let go
    /// @return the length of the step made [s]: that of the input, or a shorter one, where bodies would meet
    /// too deep
    Real run(const StepInput<Real>& wanted, Real shortest, Nodes<Real>& previous, Nodes<Real>& current,
             StageTimer* timer);

    /// Whether the last run found values that are finite.
    bool is_made() const { return is_made_; }
    /// In place of what it found, if they are not: nodes stay where they are.
    void stand_still(const Nodes<Real>& previous, Nodes<Real>& current);

    /// A response to collisions has changed nodes since the last step: energies are found anew.
    void change() { energy_.change(); }
    /// Goes on from where bodies were put between steps, if nothing is in between but they themselves.
    /// @param nodes where they were put @return whether nothing was; else they have to go back
    bool follow(const Nodes<Real>& from, Nodes<Real>& nodes);

    /// What presses objects at the end of the last step.
    ContactForces contact_forces() const;
    void set_attachments(const std::vector<Attachment>& attachments);
    std::vector<AttachmentForce> attachment_forces(const Nodes<Real>& nodes) const {
        return attachments_.forces(nodes);
    }
    std::size_t attachment_count() const { return attachments_.count(); }
    /// Bodies.
    std::vector<std::uint32_t> moved_by(std::span<const MotorTarget> motors) const {
        return attachments_.moved_by(motors);
    }
    /// From now on. @param drives of cavities; empty: those of the start @return bodies whose gas changes
    std::vector<std::uint32_t> set_cavity_drives(std::span<const double> drives);
    /// Of elements, contacts and hands on held nodes in the last step.
    /// @param forces output [N], shape [nodes]; empty before it. Those of bodies asleep stay.
    void find_forces_on_held(const StepInput<Real>& input, const Nodes<Real>& previous,
                             std::vector<glm::dvec3>& forces);
    /// Of the last step.
    const Islands& islands() const { return islands_; }
    const ContactSurface& surface() const { return *surface_; }

    /// When the last step has ended [J].
    double contact_energy() const { return energy_.in_contacts(); }

    /// What all solves so far have cost.
    const SolveCounts& solve_counts() const { return solve_counts_; }

private:
    using Field = std::vector<Vec3<Real>>;
    // A contact's force on its second side when a step has ended [N].
    struct Acting {
        ContactRow<Real> row;
        Vec3<Real> normal, friction;
    };

    void forget();
    void begin(const StepInput<Real>& input, const Nodes<Real>& previous);
    bool wake_near(const StepInput<Real>& input, Nodes<Real>& previous);
    bool is_asleep(const ContactRow<Real>& row) const;
    Real compliance(std::size_t n, Real inverse_mass, Real step) const;
    void predict(const StepInput<Real>& input, const Nodes<Real>& previous);
    Vec3<Real> acceleration(const StepInput<Real>& input, const Nodes<Real>& previous, std::size_t n) const;
    void find_targets(const StepInput<Real>& input, const Nodes<Real>& previous);
    void find_released(const Nodes<Real>& previous);
    bool is_torn(bool limits);
    std::vector<std::uint32_t> count_held(const Nodes<Real>& nodes) const;
    void linearise(const StepInput<Real>& input, const Nodes<Real>& previous);
    Real deepest() const;
    bool turns_far() const;
    bool shorten(StepInput<Real>& input) const;
    bool detect(const Nodes<Real>& previous, bool is_shortest, bool own = true);
    bool guard(const Nodes<Real>& previous, const std::vector<Vec4<Real>>& wanted, Nodes<Real>& current);
    bool hold_blocked(Nodes<Real>& previous) const;
    std::vector<std::uint32_t> stop_guarded(std::span<const Vec4<Real>> wanted, Nodes<Real>& current) const;
    template <class Counts>
    bool any_moves(const Nodes<Real>& previous, const Counts& counts) const;
    void finish(const StepInput<Real>& input, const Nodes<Real>& previous, Nodes<Real>& current);

    std::shared_ptr<const Model> model_;
    std::shared_ptr<const ContactSurface> surface_;
    bool contacts_, own_;
    RigidBodies<Real> rigid_bodies_;
    FindPairs<Real> pairs_;
    ContactRows<Real> rows_;
    AttachmentRows<Real> attachments_;
    Guard<Real> guard_;
    Restitution<Real> restitution_;
    EnergyAccount<Real> energy_;
    StepSystem<Real> system_;
    SolveCounts solve_counts_;
    TimeScheme<Real> scheme_;
    std::uint32_t parts_ = 1;  // into which steps are divided
    Paces<Real> paces_;
    std::vector<std::uint8_t> asleep_;        // bodies
    std::vector<std::uint32_t> held_counts_;  // of bodies' nodes, when the last step began
    Islands islands_;
    Real step_ = 0;
    bool is_made_ = true;
    std::vector<double> cavity_drives_;
    std::vector<std::uint8_t> blocked_;          // objects, in the last guard
    std::vector<Real> compliances_;              // of nodes in contacts, 1 / h_i [m/N]
    Field expected_;                             // displacements without forces [m]
    std::vector<Vec4<Real>> ends_, velocities_;  // velocities: with damping times of this step
    std::vector<Acting> acting_;
};

}  // namespace gelatin::cpu
