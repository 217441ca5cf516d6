#pragma once

#include <cstddef>
#include <filesystem>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "gelatin/drag.h"
#include "gelatin/export.h"
#include "gelatin/pull.h"
#include "gelatin/scene.h"
#include "gelatin/views.h"

namespace gelatin {

struct Model;  // tets and springs, as the solvers have them; not public

enum class Backend { automatic, gl, cpu };

struct SimulatorOptions {
    Backend backend =
        Backend::automatic;            ///< automatic: GL on a GPU, the CPU where OpenGL is a software driver
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

/// Nodes, faces and edges that were near each other in a step, before its response.
struct ProximityStatistics {
    std::size_t node_face =
        0;  ///< pairs of a node and a face nearer than CollisionSettings::proximity_radius
    std::size_t edge_edge = 0;  ///< pairs of edges, each counted from both edges
    std::size_t lost = 0;       ///< of these, found but not stored: too many for the GPU's buffers
    double nearest_gap = std::numeric_limits<double>::infinity();  ///< smallest distance [m]
};

/// A force on an object from another one, or from a collider, when the last step ended (of a divided step,
/// its last part). For CollisionResponse::contact.
struct ContactForce {
    std::size_t object = 0;                    ///< index in Scene::objects
    std::optional<std::size_t> other = {};     ///< index in Scene::objects, greater than `object`; or
    std::optional<std::size_t> collider = {};  ///< index in Scene::colliders
    double normal[3] = {};                     ///< pressure on the object [N]
    double friction[3] = {};                   ///< friction on the object [N]
    std::size_t points = 0;                    ///< where they press each other
};

/// What a pin or a handle exerts on its object to hold its nodes where they are, when the last step ended:
/// the mass of these nodes times their acceleration, less all other forces on them. For SolverKind::vbd on
/// the CPU.
struct HoldingForce {
    std::size_t object = 0;  ///< index in Scene::objects
    bool is_pin = false;     ///< otherwise a handle
    std::size_t index = 0;   ///< in ObjectDescription::pins or handles
    double force[3] = {};    ///< on the object [N]
    double torque[3] = {};   ///< on the object, about the centre of the nodes [N m]
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
    std::size_t contacts = 0;                        ///< nodes on a collider
    double deepest_penetration = 0.0;                ///< of a node into a collider [m]
    std::vector<double> volume_ratio;                ///< volume divided by rest volume, by object
    std::optional<ProximityStatistics> proximities;  ///< of the last step; empty without a proximity radius
    std::vector<ContactForce> contact_forces;        ///< by object, then others, then colliders
    std::vector<HoldingForce> holding_forces;        ///< in the order of Simulator::held_nodes
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
    /// For scenes with pins or handles and SolverKind::vbd on the CPU, else empty: x, y, z of the force that
    /// holds each node [N], shape [nodes][3]; 0 for those that nothing holds.
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

    /// Continues from the state of another simulation, with the masses, materials and settings of this one's
    /// own scene. Bodies with the same name and tets get the other one's positions, velocities and drags;
    /// other bodies start as their scene says.
    void go_on_from(const Simulator& other);

    /// Sets the user's pull; empty: ends it, and bodies keep their momentum. Its work is unknown, so the
    /// energy balance is not checked while it lasts. @pre nodes are in the model, their stiffnesses positive
    void set_pull(const std::optional<Pull>& pull);
    /// Moves the pull's target [m]. @pre set_pull with a pull
    void move_pull(const glm::dvec3& target);

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
    /// @pre pending_statistics() > 0. @throws Diverged as advance_frame, for the steps until that frame; and
    /// if all bodies together have more energy than the start, gravity and loads explain.
    FrameStatistics take_statistics();

    /// Durations of each stage since the last call [ms]; empty unless `time_stages`. With `time_parts` also
    /// those of the parts of "advance_nodes", as "advance_nodes.descend", one for each time that a part ran.
    std::vector<std::pair<std::string, std::vector<double>>> take_stage_times();

    /// Positions and velocities on the host; waits for the GPU.
    HostFrame read_frame() const;

    /// Buffers to draw from, with up-to-date normals and overlays. Needs a context (the GL backend or
    /// `need_gl`).
    RenderView render_view(const Overlays& overlays = {});

    /// Saves the complete, exact state, so that a run can continue later. The file is written completely or
    /// not at all. @throws SystemError; Diverged as check(): a diverged state is never saved.
    void save_checkpoint(const std::filesystem::path& file) const;
    /// @throws InvalidInput if the file is not a checkpoint, is damaged, or belongs to another scene.
    void load_checkpoint(const std::filesystem::path& file);

private:
    friend struct SimulatorInternals;
    Simulator(const Scene& scene, std::shared_ptr<const Model> model, const SimulatorOptions& options);

    struct Impl;
    explicit Simulator(std::unique_ptr<Impl> impl);
    std::unique_ptr<Impl> impl_;
};

}  // namespace gelatin
