#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "gelatin/drag.h"
#include "gelatin/export.h"
#include "gelatin/pull.h"
#include "gelatin/scene.h"
#include "gelatin/views.h"

namespace gelatin {

class Recording;
struct Model;  // tets and springs, as the solvers have them; not public

enum class Backend { automatic, gl, cpu };

struct SimulatorOptions {
    Backend backend =
        Backend::automatic;  ///< automatic: GL on a GPU, but the CPU where bodies may meet by contact
    bool use_current_context = false;  ///< simulate and draw in the host application's context
    bool need_gl = false;              ///< create a GL context for drawing even if the CPU simulates
    bool gl_debug = false;             ///< create a debug context, with messages to the log
    std::optional<int> gl_device;      ///< EGL device index
    bool time_stages = false;          ///< fill Simulator::take_stage_times
    bool time_parts = false;           ///< and with the parts of an implicit step; needs time_stages
};

/// Nodes and faces include those of colliders' surfaces.
struct Counts {
    std::size_t objects = 0, nodes = 0, springs = 0, faces = 0, tets = 0;
};

/// A contiguous part of an array.
struct IndexRange {
    std::uint32_t first = 0, count = 0;
    std::uint32_t end() const { return first + count; }
};

/// What belongs to one object in the arrays of all objects.
struct ObjectInfo {
    std::string name;
    IndexRange nodes;          ///< of Simulator::positions and others
    IndexRange faces;          ///< of Simulator::faces
    IndexRange tets;           ///< of Simulator::tets
    double mass = 0.0;         ///< [kg]
    double rest_volume = 0.0;  ///< [m^3]
    bool is_rigid = false;     ///< without tets; four of its nodes are on no face
};

/// Nodes, faces and edges that were near each other in a step, before its response.
struct ProximityStatistics {
    std::size_t node_face =
        0;  ///< pairs of a node and a face nearer than CollisionSettings::proximity_radius
    std::size_t edge_edge = 0;  ///< pairs of edges, each counted from both edges
    std::size_t lost = 0;       ///< of these, found but not stored: too many for the GPU's buffers
    double nearest_gap = std::numeric_limits<double>::infinity();  ///< smallest distance [m]
};

/// A force on an object from another one, or from a collider, when the last step ended, or the last of its
/// adaptive substeps. For CollisionResponse::contact.
struct ContactForce {
    std::size_t object = 0;                    ///< index in Scene::objects
    std::optional<std::size_t> other = {};     ///< index in Scene::objects, greater than `object`; or
    std::optional<std::size_t> collider = {};  ///< index in Scene::colliders
    double normal[3] = {};                     ///< pressure on the object [N]
    double friction[3] = {};                   ///< friction on the object [N]
    std::size_t points = 0;                    ///< where they press each other
};

/// What a pin or a handle exerts on its object to hold its nodes where they are, when the last step ended:
/// the mass of these nodes times their acceleration, less all other forces on them. For SolverKind::implicit
/// on the CPU.
struct HoldingForce {
    std::size_t object = 0;  ///< index in Scene::objects
    bool is_pin = false;     ///< otherwise a handle
    std::size_t index = 0;   ///< in ObjectDescription::pins or handles
    double force[3] = {};    ///< on the object [N]
    double torque[3] = {};   ///< on the object, about the centre of the nodes [N m]
};

/// The coordinate of a joint when the last step has ended: an angle [rad] or a length [m].
struct JointStatus {
    double position = 0.0;
    double speed = 0.0;   ///< [rad/s] or [m/s]
    double effort = 0.0;  ///< of limits, spring and motor, or of what keeps a distance [N m] or [N]
};

/// What an attachment does when the last step has ended.
struct AttachmentStatus {
    std::string name;        ///< AttachmentDescription::name, or "attachment 1", by its place in the scene
    double force[3] = {};    ///< on its object [N]; of a broken one, the last one
    bool is_broken = false;  ///< for good
    std::optional<JointStatus> joint = {};  ///< of those with a coordinate
};

/// The gas of a cavity when the last step has ended.
struct CavityStatus {
    std::string name;        ///< CavityDescription::name, or "cavity 1", by its place in the object
    std::size_t object = 0;  ///< index in Scene::objects
    double volume = 0.0;     ///< [m^3]
    double pressure = 0.0;   ///< above the ambient one [Pa]
};

/// The measurements of one frame. SI units.
struct FrameStatistics {
    int frame = 0;
    double time = 0.0;                               ///< [s]
    double kinetic_energy = 0.0;                     ///< [J]
    double elastic_energy = 0.0;                     ///< [J]
    double potential_energy = 0.0;                   ///< [J], zero at the origin
    double momentum[3] = {};                         ///< [kg m/s], of the nodes that are not pinned
    std::size_t colliding_faces = 0;                 ///< faces that touch a face of another object
    std::size_t contacts = 0;                        ///< where colliders press bodies, or nodes on them
    double deepest_penetration = 0.0;                ///< of a node into a collider [m]
    std::vector<double> volume_ratio;                ///< volume divided by rest volume, by object
    std::optional<ProximityStatistics> proximities;  ///< of the last step; empty without a proximity radius
    std::vector<ContactForce> contact_forces;        ///< by object, then others, then colliders
    std::vector<HoldingForce> holding_forces;        ///< in the order of Simulator::held_nodes
    std::vector<AttachmentStatus> attachments;       ///< in the order of Scene::attachments
    std::vector<CavityStatus> cavities;              ///< by object, in the order of its cavities
};

/// Node positions and velocities on the host. Nodes of colliders' surfaces come after those of bodies.
struct HostFrame {
    int frame = 0;
    double time = 0.0;              ///< [s]
    std::vector<float> positions;   ///< x, y, z of each node [m], shape [nodes][3]
    std::vector<float> velocities;  ///< x, y, z of each node [m/s], shape [nodes][3]
    /// For CollisionResponse::contact, else empty: x, y, z of the force of contacts on each node [N], shape
    /// [nodes][3]; and the part of it that is friction.
    std::vector<float> contact_forces, contact_friction;
    /// For scenes with pins or handles and SolverKind::implicit on the CPU, else empty: x, y, z of the force
    /// that holds each node [N], shape [nodes][3]; 0 for those that nothing holds.
    std::vector<float> holding_forces;
};

/// A scene that runs.
///
/// Use it from one thread. With the GL backend (or `need_gl`) the simulator's context must be current on that
/// thread, as it is after construction. With the CPU backend, `advance_frame` and `step` make no GL call, so
/// another thread may run them while this one draws an earlier RenderView. Move-only.
class GELATIN_API Simulator {
public:
    /// Makes tets, springs and buffers of everything in the scene.
    /// @throws InvalidInput as validate(), for scenes that cannot be built, and for a fixed step that is not
    ///   stable (naming the largest stable one); NoOpenGl if GL is requested and there is none.
    explicit Simulator(const Scene& scene, const SimulatorOptions& options = {});
    /// Plays a recording, from its first frame on: advance_frame() and step() go to the next recorded frame,
    /// if there is one. What is drawn, read and measured is as in the run; what changes it throws
    /// InvalidInput.
    /// @param options `backend` is ignored
    /// @throws InvalidInput if its meshes are not there, or are others now, or the file is damaged
    explicit Simulator(std::shared_ptr<const Recording> recording, const SimulatorOptions& options = {});
    Simulator(Simulator&&) noexcept;
    Simulator& operator=(Simulator&&) noexcept;
    ~Simulator();

    /// Advances by one frame: `substeps()` steps. Does not wait for a GPU.
    /// @throws Diverged after a step with nodes that are not finite, or faster than the scene's energy
    /// allows,
    ///   naming the step, the node and the likely cause; with a GPU a frame or two later. The state is then
    ///   invalid until reset or load_checkpoint.
    void advance_frame();

    /// Advances by one step; `substeps()` of them make a frame. @throws as advance_frame
    void step();

    /// Returns to the start and discards pending measurements. Allowed after Diverged.
    void reset();

    /// What it plays; null: it simulates.
    const Recording* recording() const;
    /// Goes to a frame of the recording, in any order. @param index below Recording::frame_count()
    /// @throws InvalidInput if the file is damaged @pre it plays one
    void show_recorded(std::size_t index);

    /// Continues from the state of another simulation, with the masses, materials and settings of this one's
    /// own scene. Bodies with the same name and tets, or the same faces if rigid, get the other one's
    /// positions, velocities and drags; other bodies start as their scene says. What programs have set of
    /// cavities, motors and vertices of colliders stays, where these have the same names; so do attachments
    /// that they have made, as far as this scene has what is attached.
    void go_on_from(const Simulator& other);

    /// The nodes of a body that are in a region now, by their indices in the body, ascending.
    /// @throws InvalidInput for an object or a region that is not allowed
    std::vector<std::uint32_t> nodes_in(std::size_t object, const Region& region) const;

    /// The bodies come first in every array of objects, in the order of Scene::objects.
    /// @throws InvalidInput if no body has this name, naming those that there are
    std::size_t object_index(std::string_view name) const;
    /// @param object index of a body @throws InvalidInput if there is none
    ObjectInfo object(std::size_t object) const;
    /// How far a body is rotated from where the scene places it at the start: the rotation nearest to where
    /// its nodes are, in the mean of their masses; a unit quaternion. @throws InvalidInput if there is no
    /// such body
    glm::dquat rotation(std::size_t object) const;
    /// The boundary triangles of all objects' tets, and those of rigid bodies: nodes, counter-clockwise from
    /// outside; shape [faces]. They never change, and the spans are valid as long as the simulator, until
    /// set_material or pin.
    std::span<const glm::uvec3> faces() const;
    /// The nodes of all tets; shape [tets]. As faces().
    std::span<const glm::uvec4> tets() const;

    /// The nodes at present: xyz [m], inverse mass [1/kg], 0 for those that are held; shape [nodes]. The CPU
    /// backend's own array, without a copy. With the GL backend a copy, which waits for the GPU, once for
    /// each state. Valid until the state changes: by a step, a setter, a checkpoint, reset.
    std::span<const glm::vec4> positions() const;
    /// xyz [m/s], damping time of the material [s]; shape [nodes]. As positions().
    std::span<const glm::vec4> velocities() const;
    /// The force of contacts on each node [N], friction included, 0; shape [nodes]. Zero without
    /// CollisionResponse::contact. Found at the first call for each state, and valid as positions().
    std::span<const glm::vec4> node_contact_forces() const;
    /// What presses objects at present; empty without CollisionResponse::contact.
    std::vector<ContactForce> contact_forces() const;

    // What programs change between steps. Each throws InvalidInput, and then nothing has changed: for an
    // object that is no body, a wrong number of values, values that are not finite. A rigid body takes the
    // pose, or the velocity and spin, that are nearest to the values, in the mean of its nodes' masses.

    /// Puts an object's nodes somewhere else, with the velocities that they have, a rigid body with its
    /// velocity and spin [m]; shape [nodes of the object]. Held nodes stay where their pin or handle has
    /// them. With CollisionResponse::contact bodies that overlap afterwards are moved apart, as at the start,
    /// each with a warning.
    /// @throws InvalidInput if they cannot be moved apart, or a body overlaps itself where
    ///   CollisionSettings::self_collision
    void set_positions(std::size_t object, std::span<const glm::vec3> positions);
    /// Velocities of an object's nodes [m/s]; shape [nodes of the object]. Held nodes keep theirs.
    void set_velocities(std::size_t object, std::span<const glm::vec3> velocities);
    /// Forces on an object's nodes [N], which act until others are set; shape [nodes of the object]; empty:
    /// none. Their work is unknown, so the energy balance is not checked while they act.
    void set_forces(std::size_t object, std::span<const glm::vec3> forces);
    /// Holds nodes where they are, until unpin. They are one pin more of held_nodes(), and may be dragged.
    /// Not part of checkpoints; reset() releases them. It makes the solver's tables anew, which takes about
    /// as long as making the simulator with its meshes from the cache.
    /// @param nodes by their index in the object, distinct, not held yet, at least one
    void pin(std::size_t object, std::span<const std::uint32_t> nodes);
    /// Releases all nodes of an object that pin() holds. Takes as long as pin().
    void unpin(std::size_t object);
    /// Replaces the scene's material of the same name, with any other values. Makes the tets' and the
    /// solver's tables anew, as pin(); a fixed step must be stable with it.
    void set_material(const Material& material);

    /// Sets the users' pulls, all at once; a node may be in several. Bodies keep their momentum when a pull
    /// ends. The work is unknown, so the energy balance is not checked while any lasts.
    /// @throws InvalidInput for nodes that there are not, or twice in a pull, and stiffnesses that are not
    ///   positive
    void set_pulls(std::vector<Pull> pulls);
    /// Moves a pull's target [m]. @param pull index in the last set_pulls @throws InvalidInput if there is
    /// none
    void move_pull(std::size_t pull, const glm::dvec3& target);

    /// Attaches an object from now on, where everything is now: regions, points and lines are in world
    /// coordinates at present. Scene::attachments has it, too. Part of checkpoints; reset() removes it. It
    /// may have the name of a broken one that attach() has made: that one is then called by its place.
    /// @return its place in Scene::attachments @throws InvalidInput as validate(), and if there is no node
    std::size_t attach(const AttachmentDescription& attachment);
    /// Breaks an attachment for good, until reset(). @throws InvalidInput if there is none
    void detach(std::size_t attachment);
    /// What the motor of a joint does from now on, until reset(). Part of checkpoints.
    /// @throws InvalidInput as validate(), and if there is no such attachment
    void set_motor(std::size_t attachment, const JointMotor& motor);
    /// In the order of Scene::attachments; empty for recordings.
    std::vector<AttachmentStatus> attachments() const;

    /// Where the vertices of a collider with AnimationByProgram are to be when a frame's time from now has
    /// passed: they go there at even speed. Frames without another call leave them there.
    /// @param collider its name @param vertices as those of the collider's shape: in its order, before scale,
    ///   rotation, position and keyframes place it [m]; shape [vertices]
    /// @throws InvalidInput if there is no such collider, and for a wrong number of vertices or ones that are
    ///   not finite
    void set_collider_vertices(const std::string& collider, const std::vector<glm::dvec3>& vertices);
    /// The gas that a cavity has from now on, in place of its keyframes, until reset(). Part of checkpoints.
    /// @param cavity index in cavities()
    /// @throws InvalidInput as validate(), and if there is no such cavity
    void set_cavity(std::size_t cavity, const CavityGas& gas);
    /// @throws InvalidInput if the object has none of this name, naming those that there are
    std::size_t cavity_index(std::string_view object, std::string_view name) const;
    /// By object, in the order of ObjectDescription::cavities.
    std::vector<CavityStatus> cavities() const;

    /// Called at the begin and at the end of each step, on its thread; empty: not any more. It may read and
    /// change the state, but not step. What it throws comes out of step(); if that is at the end, the step
    /// has been made.
    using StepCallback = std::function<void(Simulator&)>;
    void before_step(StepCallback callback);
    void after_step(StepCallback callback);

    /// What the scene's pins and handles hold at present, in a fixed order.
    std::vector<HeldNodes> held_nodes() const;
    /// Sets the target of a pin's or handle's drag. In the following steps its nodes approach the target from
    /// where they are, no faster than the body can follow. A handle's keyframes continue; the drag is added
    /// to them. The work is not included in the energy balance, like that of a pull.
    /// @param held index in held_nodes() @pre target.turn is a unit quaternion
    void drag(std::size_t held, const Drag& target);

    /// Waits for the GPU. @throws Diverged if any step so far has diverged.
    void check() const;

    int frame() const;            ///< completed frames; 0 is the start
    double time() const;          ///< [s]
    int substeps() const;         ///< steps per frame
    double step_size() const;     ///< [s]
    bool uses_gl() const;         ///< true if the GL backend simulates
    std::string backend() const;  ///< "gl" or "cpu"
    std::string device() const;   ///< name of the GPU, or of the CPU's instruction set
    const Scene& scene() const;
    Counts counts() const;

    /// Starts measuring the present frame. `take_statistics` returns the results in order; called one frame
    /// later, it does not wait.
    void begin_statistics();
    std::size_t pending_statistics() const;
    /// @throws InvalidInput unless pending_statistics() > 0; Diverged as advance_frame, for the steps until
    /// that frame, and if all bodies together have more energy than the start, gravity and loads explain.
    FrameStatistics take_statistics();

    /// Durations of each stage since the last call [ms]; empty unless `time_stages`. With `time_parts` also
    /// those of the parts of "advance_nodes", as "advance_nodes.descend", one for each time that a part ran.
    std::vector<std::pair<std::string, std::vector<double>>> take_stage_times();

    /// Positions and velocities on the host; waits for the GPU.
    HostFrame read_frame() const;

    /// Buffers to draw from, with up-to-date normals and overlays. Needs a context (the GL backend or
    /// `need_gl`).
    RenderView render_view(const Overlays& overlays = {});

    /// Saves the exact state, to continue later with the same numbers. The file is written completely
    /// or not at all. @throws SystemError; Diverged as check(): a diverged state is never saved.
    void save_checkpoint(const std::filesystem::path& file) const;
    /// Continues from a checkpoint, or from a frame of a recording.
    /// @param frame its number in the recording; empty: the last one
    /// @throws InvalidInput if the file is neither, is damaged, or belongs to another scene, or if there is
    /// no
    ///   such frame.
    void load_checkpoint(const std::filesystem::path& file, std::optional<int> frame = {});

private:
    friend struct SimulatorInternals;
    Simulator(const Scene& scene, std::shared_ptr<const Model> model, const SimulatorOptions& options);
    Simulator(std::shared_ptr<const Recording> recording, std::shared_ptr<const Model> model,
              const SimulatorOptions& options);

    struct Impl;
    explicit Simulator(std::unique_ptr<Impl> impl);
    std::unique_ptr<Impl> impl_;
};

}  // namespace gelatin
