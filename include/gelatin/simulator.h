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
#include "gelatin/pull.h"
#include "gelatin/scene.h"
#include "gelatin/views.h"

namespace gelatin {

struct Model;

enum class Backend { automatic, gl, cpu };

struct SimulatorOptions {
    Backend backend =
        Backend::automatic;            ///< automatic: GL on a GPU, the CPU where OpenGL is a software driver
    bool use_current_context = false;  ///< draw with and simulate in the host application's context
    bool need_gl = false;              ///< make a GL context for drawing even if the CPU simulates
    bool gl_debug = false;             ///< a debug context, messages to the log
    std::optional<int> gl_device;      ///< EGL device index
    bool time_stages = false;          ///< fill Simulator::stage_times
};

struct Counts {
    std::size_t objects = 0, nodes = 0, springs = 0, faces = 0, tets = 0;
};

/// What was near in a step, before its response.
struct ProximityStatistics {
    std::size_t node_face = 0;  ///< nodes and faces nearer than CollisionSettings::proximity_radius
    std::size_t edge_edge = 0;  ///< the same of two edges, each pair seen from both
    std::size_t lost = 0;       ///< of these, found but not kept: too many for the GPU's buffers
    double nearest_gap = std::numeric_limits<double>::infinity();  ///< least distance of all [m]
};

/// What is measured of one frame. SI units.
struct FrameStatistics {
    int frame = 0;
    double time = 0.0;                               ///< [s]
    double kinetic_energy = 0.0;                     ///< [J]
    double elastic_energy = 0.0;                     ///< [J]
    double potential_energy = 0.0;                   ///< [J], zero at the origin
    double momentum[3] = {};                         ///< [kg m/s], of the nodes that are not pinned
    std::size_t colliding_faces = 0;                 ///< faces of objects that meet
    std::size_t contacts = 0;                        ///< nodes that touch a collider
    double deepest_penetration = 0.0;                ///< of a node into a collider [m]
    std::vector<double> volume_ratio;                ///< volume over rest volume, by object
    std::optional<ProximityStatistics> proximities;  ///< of the last step; empty where none are sought
};

/// Node positions on the host, with the packed faces over them.
struct HostFrame {
    int frame = 0;
    double time = 0.0;              ///< [s]
    std::vector<float> positions;   ///< x, y, z of each node [m], shape [nodes][3]
    std::vector<float> velocities;  ///< x, y, z of each node [m/s], shape [nodes][3]
};

/// A scene that runs.
///
/// Use it from one thread; with the GL backend (or `need_gl`) that thread needs the simulator's context
/// current, which it is after construction. With the CPU backend, `advance_frame` and `step` make no GL call:
/// another thread may run them while this one draws a RenderView taken before. Move-only.
class Simulator {
public:
    /// Makes tets, springs and buffers of everything in the scene.
    /// @throws InvalidInput for scenes that cannot be built or a fixed step that is not stable (naming the
    /// largest
    ///   safe one); NoOpenGl if GL is asked for and there is none.
    explicit Simulator(const Scene& scene, const SimulatorOptions& options = {});
    /// The same with tets and springs that were made before: what build_model made of this very scene.
    Simulator(const Scene& scene, std::shared_ptr<const Model> model, const SimulatorOptions& options = {});
    Simulator(Simulator&&) noexcept;
    Simulator& operator=(Simulator&&) noexcept;
    ~Simulator();

    /// Advances by one frame: `substeps()` steps. Does not wait for a GPU.
    /// @throws Diverged after a step that left nodes which are not finite or faster than the scene's energy
    ///   allows, naming it, the node and the likely cause; with a GPU a frame or two late. The state is then
    ///   of no use, and only load_checkpoint helps.
    void advance_frame();

    /// Advances by one step; `substeps()` of them make a frame. @throws as advance_frame
    void step();

    /// Back to the start, measurements under way forgotten; after Diverged, too.
    void reset();

    /// Goes on from where another simulation is, with the masses, materials and settings of this one's own
    /// scene. Bodies of the same name and tets are where they are there, what is held of them as it has been
    /// dragged; others begin at their start.
    void go_on_from(const Simulator& other);

    /// What a user's hand holds from now on; empty: nothing, and bodies keep the momentum that they have.
    /// What it does is not accounted for: meanwhile energy is not held against what start, gravity and loads
    /// explain. @pre nodes are in the model, their stiffnesses positive
    void set_pull(const std::optional<Pull>& pull);
    /// Moves the hand [m]. @pre it holds something
    void move_pull(const glm::dvec3& target);

    /// What the scene's pins and handles hold now, in a fixed order.
    std::vector<HeldNodes> held_nodes() const;
    /// Drags what one of them holds there, from where it is by now, in the steps that follow: no faster than
    /// the body can follow. Of a handle that follows keyframes, the way that they lead it is on top. The work
    /// is not accounted for, as a hand's. @param held index in held_nodes() @pre the turn is a unit one
    void drag(std::size_t held, const Drag& target);

    /// Waits for the GPU. @throws Diverged if any step so far left the state so.
    void check() const;

    int frame() const;            ///< frames done; 0 is the start
    double time() const;          ///< [s]
    int substeps() const;         ///< steps a frame
    double step_size() const;     ///< [s]
    bool uses_gl() const;         ///< true if the GL backend simulates
    std::string backend() const;  ///< "gl" or "cpu"
    std::string device() const;   ///< the GPU's, or the CPU path's, own name
    const Scene& scene() const;
    const Model& model() const;
    Counts counts() const;

    /// Starts measuring the present frame; `take_statistics` gives it, in order, a frame late without
    /// waiting.
    void begin_statistics();
    std::size_t pending_statistics() const;
    /// @pre pending_statistics() > 0. @throws Diverged as advance_frame, for the steps until that frame; and
    /// if all bodies together have energy that neither the start nor gravity explains.
    FrameStatistics take_statistics();

    /// Durations by stage since the last call [ms]; empty unless `time_stages`.
    std::vector<std::pair<std::string, std::vector<double>>> take_stage_times();

    /// Positions and velocities on the host; waits for the GPU.
    HostFrame read_frame() const;

    /// Buffers to draw from, normals and overlays up to date. Needs a context (the GL backend or `need_gl`).
    RenderView render_view(const Overlays& overlays = {});

    /// The whole state, so that a run can go on later: exact, whole or not at all.
    /// @throws SystemError; Diverged as check(): a state that is of no use never becomes a checkpoint.
    void save_checkpoint(const std::filesystem::path& file) const;
    /// @throws InvalidInput if it is not a checkpoint, damaged, or of another scene.
    void load_checkpoint(const std::filesystem::path& file);

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace gelatin
