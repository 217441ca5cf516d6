#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "core/stage_timer.h"
#include "cpu/contact/contacts.h"
#include "cpu/descent/coarse_step.h"
#include "cpu/descent/collider_contacts.h"
#include "cpu/descent/contact_forces.h"
#include "cpu/descent/energy_bound.h"
#include "cpu/descent/joint_move.h"
#include "cpu/descent/node_sweep.h"
#include "cpu/descent/plane_landing.h"
#include "cpu/descent/rest_watch.h"
#include "cpu/descent/rigid_move.h"
#include "cpu/descent/rigid_rebound.h"
#include "cpu/descent/step_division.h"
#include "cpu/descent/step_objective.h"
#include "cpu/descent/tangled_bodies.h"
#include "cpu/drive/pulls.h"
#include "cpu/nodes.h"
#include "model/descent/device_sweeps.h"
#include "model/model.h"
#include "model/solver.h"

namespace gelatin::cpu {

/// Vertex block descent (Chen et al. 2024): a step of implicit Euler as the minimum of
///   G(x) = sum_i m_i / (2 h^2) |x_i - y_i|^2 + E(x),   y = x_t + h v_t + h^2 (g + f / m),
/// with f the force of loads. G is a sum of elements (StepObjective), and three moves lower it in turn:
/// - NodeSweep: each node by one Newton step on its own three coordinates, all nodes of one colour at once;
/// - RigidMove, after every second sweep and after the last: bodies that nothing holds, as rigid ones. That
///   keeps their momentum, which sweeps alone lose;
/// - JointMove, where bodies are near each other: those of an island together, in place of RigidMove;
/// - CoarseStep, after the first of every six sweeps: clusters of nodes, for long stiff bodies that would
///   need thousands of sweeps (docs/block-descent.md).
/// Stable for any step and start. The same bits for any number of threads.
template <class Real>
class BlockDescent {
public:
    /// Bodies of so many nodes in all make their sweeps one batch after the other, or beside each other on
    /// several threads: less than a processor's caches hold. Smaller ones would leave lanes of SIMD empty.
    static constexpr std::uint32_t kNodesABatch = 4096;

    /// @param contacts between bodies; null: bodies do not meet within a step
    /// @param device that makes the sweeps of bodies with contacts; null: the host makes them; must outlive
    /// this
    BlockDescent(std::shared_ptr<const Model> model, const DescentSettings& settings,
                 std::uint32_t nodes_a_batch = kNodesABatch,
                 std::unique_ptr<Contacts<Real>> contacts = nullptr, DeviceSweeps* device = nullptr);

    /// To be called when nodes were set from outside.
    void restart(std::span<const Vec4<Real>> positions) {
        if (bodies_) bodies_->restart(positions);
        if (division_) division_->restart();
        if (rest_watch_) rest_watch_->restart();
        rebound_.restart();
        energy_.restart();
        contacts_.restart();
        last_step_ = 0.0;
    }

    /// Into how many equal steps a step of `step` seconds from `nodes` is to be divided. To be called before
    /// the first of them.
    int parts(double step, const Nodes<Real>& nodes) {
        if (bodies_) energy_.begin_parts(*bodies_);
        return division_
                   ? division_->parts(step, nodes, contacts_.objects, bodies_.get(), settings_.iterations)
                   : 1;
    }

    /// Whether all bodies rest, and a step of `step` seconds may be left out. Then `nodes` are at rest.
    /// @param load_factors of the model's loads @param is_pulled whether a hand holds a body
    bool rests(double step, std::span<const float> load_factors, bool is_pulled, Nodes<Real>& nodes);

    /// To be called where bodies were put elsewhere since the last step: goes there as far as others let
    /// them.
    /// @param matched bodies that were put elsewhere, and move as rigid ones
    /// @param nodes input: where they were put; output: where they are
    void follow(Real step, std::span<const std::uint32_t> matched, Nodes<Real>& nodes, StageTimer* timer);

    /// A step of `step` seconds from `previous`; writes `current`.
    /// @param current's velocities are those one step before `previous` if `has_earlier`, else not looked at
    /// @param load_forces [N], shape [nodes], or empty @param pulls null: no hand holds anything
    /// @param timer of the parts of the step; null: none @param parts of a divided step: it makes its share
    /// of the sweeps
    void run(Real step, bool has_earlier, const Nodes<Real>& previous, Nodes<Real>& current,
             std::span<const Vec4<Real>> load_forces = {}, const Pulls<Real>* pulls = nullptr,
             StageTimer* timer = nullptr, int parts = 1);

    /// At the end of the last step; none before the first.
    ContactForces contact_forces(const std::vector<Vec4<Real>>& positions) const {
        const std::vector<glm::dvec3> none(positions.size(), glm::dvec3(0.0));
        if (last_step_ == Real(0)) return {{}, none, none};
        std::vector<Vec3<Real>> forces(positions.size());
        objective_.find_forces(positions, nullptr, forces);
        return find_contact_forces<Real>(*model_, bodies_.get(), contacts_, forces, positions);
    }

    /// Handles with nodes that bodies keep from where their poses have them.
    std::vector<std::uint32_t> held_up(std::span<const HandlePose> poses,
                                       const std::vector<Vec4<Real>>& positions) const {
        return bodies_ ? bodies_->held_up(poses, positions) : std::vector<std::uint32_t>();
    }

    /// Of elements, contacts and a hand on each held node at the end of the last step [N], shape [nodes];
    /// empty before the first step.
    std::vector<glm::dvec3> forces_on_held(const std::vector<Vec4<Real>>& positions,
                                           const Pulls<Real>* pulls) const;

private:
    using Positions = std::vector<Vec4<Real>>;
    // The parts of its last step's velocity and acceleration with which the guess of a body goes on that
    // something presses.
    struct Outlook {
        bool is_pressed = false;
        Real velocity = Real(0), acceleration = Real(0);
        bool is_soft() const { return acceleration > Real(0); }  // for this part of a step
    };

    void start(Real step, bool has_earlier, const Nodes<Real>& previous,
               std::span<const Vec4<Real>> load_forces, const Pulls<Real>* pulls, Nodes<Real>& current);
    void make_moves(Real step, Positions& positions, StageTimer* timer);
    void shorten_guess(Real step, Positions& positions);
    bool is_soft(std::size_t object, Real step) const;
    void slow_down_tangled(const Nodes<Real>& previous, std::span<const Vec4<Real>> load_forces,
                           const Pulls<Real>* pulls, Nodes<Real>& current);
    void find_outlooks(Real step, bool is_part, const Nodes<Real>& previous);
    void go_on_to_guess(Positions& positions, StageTimer* timer);
    void keep_energy(Positions& positions, StageTimer* timer);
    void move_together(bool last, Positions& positions, StageTimer* timer,
                       Turning turning = Turning::straight);
    int end_of_run(int first) const;
    void make_sweeps(int first, int end, Positions& positions, StageTimer* timer);
    void make_sweeps_on_device(int first, int end, Positions& positions, StageTimer* timer);
    void take_from_device(Positions& positions);
    template <class Visit>
    void for_batches(const Visit& visit) const;
    bool moves_bodies(int sweep) const { return is_last(sweep) || (sweep + 1) % kSweepsAMotion == 0; }
    bool is_last(int sweep) const { return sweep + 1 == sweeps_; }
    void finish(Real step, const Nodes<Real>& previous, Nodes<Real>& current);

    std::shared_ptr<const Model> model_;
    DescentSettings settings_;
    int sweeps_;                      // of this step
    Real last_step_ = Real(0);        // length of the step before [s]; 0: as this one
    std::vector<double> wave_times_;  // by object [s]
    std::optional<StepDivision<Real>> division_;
    std::optional<RestWatch<Real>> rest_watch_;
    std::unique_ptr<Contacts<Real>> bodies_;
    const Contacts<Real>* acting_ = nullptr;  // in this step: null while bodies are apart
    StepObjective<Real> objective_;
    ColliderContacts<Real> contacts_;
    NodeSweep<Real> sweep_;
    RigidMove<Real> rigid_move_;
    JointMove<Real> joint_move_;
    RigidRebound<Real> rebound_;
    TangledBodies<Real> tangled_;
    EnergyBound<Real> energy_;  // of bodies that meet others
    std::optional<SecantStep<Real>> secant_;
    Positions ends_;                             // of bodies' motions
    std::vector<Outlook> outlooks_;              // by object
    double slow_way_ = 0.0;                      // how far slow bodies come in this step at most [m]
    std::optional<PlaneLanding<Real>> landing_;  // where bodies meet
    std::optional<CoarseStep<Real>> coarse_;     // where there are clusters
    DeviceSweeps* device_;
    std::vector<glm::vec4> device_positions_;
    ContactLimits device_limits_;
    DeviceContacts device_contacts_;
};

}  // namespace gelatin::cpu
