#pragma once

#include <cassert>
#include <glm/vec4.hpp>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/stage_timer.h"
#include "gelatin/pull.h"
#include "gelatin/scene.h"
#include "model/drive/attachment.h"
#include "model/model.h"

namespace gelatin {

/// Positions and velocities of all nodes on the host; the fourth components are the model's.
struct State {
    std::vector<glm::vec4> positions;   ///< xyz [m], inverse mass [1/kg], shape [nodes]
    std::vector<glm::vec4> velocities;  ///< xyz [m/s], damping time [s], shape [nodes]
    /// The velocities one step before, from which solvers guess those of the next step; empty before the
    /// first step.
    std::vector<glm::vec4> earlier_velocities;
    /// What the solver knows besides, for itself alone (Solver::memory). Empty: nothing.
    std::string memory{};
};

/// Of SolverKind::implicit.
struct ImplicitSettings {
    int iterations = 10;         ///< of conjugate gradients for each linear system, at most; >= 1
    bool divides_steps = false;  ///< into parts, more where bodies are near each other
    bool sleeps = false;         ///< whether bodies are left out while they rest; with contacts alone
};

/// Whether implicit steps have contacts between bodies, with colliders, or of bodies with themselves.
/// @param collision with a response, as Simulator chooses it; without one there are none
inline bool has_contacts(const Model& model, const CollisionSettings& collision) {
    return collision.response == CollisionResponse::contact &&
           (model.objects.size() > 1 || collision.self_collision.value_or(true));
}

/// A node nearer to a collider than this [m] touches it, in explicit steps.
constexpr double kContactDistance = 1e-5;

/// Below this speed [m/s], which gravity adds in two steps, nodes that collide do not bounce.
double resting_speed(const glm::vec3& gravity, double step);

/// Sums over one object at one moment.
struct ObjectMeasure {
    glm::dvec3 momentum{0.0};           ///< [kg m/s], of the nodes that are not pinned
    double kinetic_energy = 0.0;        ///< [J]
    double elastic_energy = 0.0;        ///< [J]
    double potential_energy = 0.0;      ///< [J], zero at the origin, of the nodes that are not pinned
    double volume = 0.0;                ///< [m^3]
    double deepest_penetration = 0.0;   ///< of a node into a collider [m]
    std::uint32_t contacts = 0;         ///< nodes that touch a collider
    std::uint32_t colliding_faces = 0;  ///< that touch another object, or another part of their own
};

/// The record of watch_nodes before anything is wrong.
constexpr Alarm kNoAlarm{0xFFFFFFFFu, 0xFFFFFFFFu, 0, 0};

/// The proximities at one moment.
struct ProximityMeasure {
    std::uint32_t node_face = 0;  ///< nodes and faces
    std::uint32_t edge_edge = 0;  ///< two edges, each pair seen from both
    std::uint32_t lost = 0;       ///< of these, did not fit into a device's buffers
    double nearest = std::numeric_limits<double>::infinity();  ///< least distance of all [m]
};

/// What measuring has found.
struct Measurement {
    std::vector<ObjectMeasure> objects;           ///< shape [objects]
    std::optional<ProximityMeasure> proximities;  ///< of the last step; empty: none are sought
    /// Pairs of objects or faces that were not tested because they did not fit into a device's buffers, since
    /// the start.
    std::uint32_t lost_pairs = 0;
};

/// What presses objects when a step has ended.
struct ContactForces {
    struct Between {
        std::uint32_t object;  ///< index in Model::objects, a body's
        std::uint32_t other;   ///< index in Model::objects, greater; or of a plane in Model::colliders
        bool is_plane;
        glm::dvec3 normal{0.0}, friction{0.0};  ///< on `object` [N]
        std::uint32_t points = 0;
    };
    std::vector<Between> between;              ///< by object, others before planes
    std::vector<glm::dvec3> normal, friction;  ///< on each node [N], shape [nodes]
};

/// What pins and handles exert on bodies to hold their nodes where they are, when a step has ended.
struct HoldingForces {
    std::vector<glm::dvec3> by_handle;  ///< sums over each handle's nodes [N], shape [Model::handles]
    std::vector<glm::dvec3> torques;    ///< about the centres of their nodes [N m], shape [Model::handles]
    std::vector<glm::dvec3> nodes;      ///< [N], shape [nodes]; 0 where nothing holds a node
};

/// The nodes where they are in host memory in single precision, as of State, valid until the state changes.
struct HostNodes {
    std::span<const glm::vec4> positions, velocities;  ///< empty: they are elsewhere
};

/// What one step is made with.
struct Step {
    double size;  ///< [s]
    /// Of all handles over the step, shape [Model::handles]; empty: what they hold moves on as it does.
    std::span<const HandleMotion> motions = {};
    std::span<const NodeMotion> animated = {};  ///< of the nodes of animated handles; with motions
    /// How much of each load acts, shape [Model::loads.spans]; empty: all of all.
    std::span<const float> load_factors = {};
    /// Of attachments, in their order; empty: none acts.
    std::span<const MotorTarget> motors = {};
    /// Of cavities (Cavity::drive_at) when it ends, shape [Model::cavities]; of solvers of implicit steps on
    /// the CPU.
    std::span<const double> cavity_drives = {};
};

/// A backend: owns the state, in host or device memory, and advances it. Where a function does not say so, it
/// does not wait for a device.
class Solver {
public:
    virtual ~Solver() = default;

    /// Makes a step, with its response to collisions. Times its stages, and their parts. The first step of
    /// handles may cost as much as making the solver.
    virtual void advance(const Step& step) = 0;

    /// What hands hold from now on. @pre as of ActedNodes
    virtual void set_pulls(std::vector<Pull> pulls) = 0;
    virtual void move_pull(std::size_t pull, const glm::dvec3& target) = 0;
    /// Forces that act on nodes from now on [N], shape [nodes], or empty.
    virtual void set_forces(std::span<const glm::vec3> forces) = 0;
    /// In place of all that there were. @pre none, but for a solver of implicit steps on the CPU
    virtual void set_attachments([[maybe_unused]] const std::vector<Attachment>& attachments) {
        assert(attachments.empty());
    }

    /// Checks all nodes after the step of this number. Keeps the record of the first step after which nodes
    /// are not finite, or have more kinetic energy than `most_energy` each [J]; pinned nodes may have any
    /// speed.
    virtual void watch_nodes(std::uint32_t step_number, double most_energy) = 0;

    /// What watching has found: until now if `wait`, otherwise what a device has reported so far. Call it
    /// regularly, once a frame, because each call starts the transfer for the next one.
    virtual Alarm alarm(bool wait) = 0;

    /// Starts measuring the present state. At most two measurements may be pending.
    virtual void begin_measure() = 0;

    /// The oldest pending measurement; waits for it if necessary.
    virtual Measurement end_measure() = 0;

    /// What presses objects at present; waits for a device. Without arrays from solvers that do not find it:
    /// all but the implicit step.
    virtual ContactForces contact_forces() = 0;

    /// What pins and handles exert at present; zero before the first step. Empty without any, and from
    /// solvers that do not find it.
    virtual HoldingForces holding_forces() = 0;

    /// Of all that were set; waits for nothing.
    virtual std::vector<AttachmentForce> attachment_forces() { return {}; }

    /// The handles with nodes that bodies keep from where their poses have them, each an index in
    /// Model::handles; none without CollisionResponse::contact. Waits for a
    /// device. @param places of what handles hold [m], shape [Model::handle_nodes]
    virtual std::vector<std::uint32_t> held_up(std::span<const glm::dvec3> places) = 0;

    /// Waits for a device.
    virtual State read_state() = 0;
    /// What State::memory needs for the next step to be the same to the last bit; read_state() leaves it out.
    virtual std::string memory() { return {}; }
    virtual HostNodes host_nodes() const = 0;
    /// Discards what watching has found so far. A memory of a solver of another kind counts as none.
    virtual void write_state(const State& state) = 0;

    /// Times stages by the clock of the device on which they run.
    virtual StageTimer& stage_timer() = 0;

    virtual std::string device() const = 0;  ///< for people: "llvmpipe (LLVM 15.0.6, 256 bits)"
};

}  // namespace gelatin
