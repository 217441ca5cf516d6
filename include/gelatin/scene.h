#pragma once

#include <filesystem>
#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace gelatin {

/// What the user wrote, checked: every value is in range, every name resolves. SI units, +y is up.
/// See docs/scene-files.md for the same in TOML.

/// Four explicit schemes, and vertex block descent on implicit Euler's objective, stable at any step.
enum class SolverKind { explicit_euler, semi_implicit_euler, midpoint, rk4, vbd };

/// How spring forces reach the nodes: the paper's two kernels, or one gather fused with the integration.
enum class ForceMethod { divide_and_merge, fused };

struct SimulationSettings {
    SolverKind solver = SolverKind::vbd;
    ForceMethod forces = ForceMethod::fused;
    double frame_rate = 60.0;             ///< frames a second of simulated time [1/s], > 0
    std::optional<int> substeps;          ///< steps a frame, >= 1; empty: the fewest that are stable
    int iterations = 10;                  ///< of vbd, a step, >= 1
    glm::dvec3 gravity{0.0, -9.81, 0.0};  ///< [m/s^2]
    int frames = 600;                     ///< length of a run, >= 0

    double frame_time() const { return 1.0 / frame_rate; }  ///< [s]
};

/// How faces that cannot touch are left out before face is tested against face (docs/collision.md).
enum class BroadPhase {
    none,       ///< not at all: every face of every object against every face of every other
    boxes,      ///< the paper's: objects whose bounding boxes meet, every face against every face
    hierarchy,  ///< of those objects, the faces that trees of boxes lead to
    depth,      ///< of those objects, the faces that are hidden from all sides by others; needs OpenGL
};

/// When faces are looked at: as they lie at the end of a step, or all the way there.
enum class CollisionDetection {
    discrete,    ///< the paper's: faces that overlap at the end of the step
    continuous,  ///< and those that touch on the way, each node moving straight
};

/// What happens to objects whose faces meet: `restore` is the paper's (2.4), nodes return to where they were
/// and their velocities respond.
enum class CollisionResponse { restore };

struct CollisionSettings {
    BroadPhase broad_phase = BroadPhase::hierarchy;
    CollisionDetection detection = CollisionDetection::discrete;
    CollisionResponse response = CollisionResponse::restore;
    bool self_collision = false;  ///< faces of one object against one another too
    /// Nodes and faces, and edges, nearer than this are found [m], > 0; empty: none are sought.
    std::optional<double> proximity_radius = std::nullopt;
    double friction = 0.4;     ///< Coulomb's coefficient, >= 0
    double restitution = 0.3;  ///< normal speed after over before, in [0, 1]
};

/// What a material's elasticity is made of.
enum class MaterialModel {
    mass_spring,  ///< the paper's: springs between nodes
    neo_hookean,  ///< the tets' own, stable neo-Hookean: any Poisson's ratio (docs/physics.md)
};

/// Which of the paper's springs a material has (2.2). At least one.
struct SpringKinds {
    bool structural = true;  ///< the edges of the tets
    bool shear = false;      ///< the opposite corners of two tets that share a face
    bool flex = false;       ///< across a surface edge, and two edges apart inside
    bool operator==(const SpringKinds&) const = default;
};

struct Material {
    std::string name;
    MaterialModel model = MaterialModel::mass_spring;
    double youngs_modulus = 5e4;  ///< [Pa], > 0
    double density = 1000.0;      ///< [kg/m^3], > 0
    double poisson_ratio = 0.25;  ///< in [0, 0.49]; springs alone answer with 1/4, a volume term does the
                                  ///< rest. Neo-Hookean: in [0, 0.5)
    double damping =
        0.0;  ///< Kelvin-Voigt relaxation time [s], >= 0: a spring's damping is damping * stiffness
    /// Of mass_spring alone. Empty: springs whose stiffnesses are fitted to each mesh, so that the body
    /// answers with youngs_modulus. With kinds: the paper's, not fitted, which answer softer.
    std::optional<SpringKinds> springs;
};

struct SphereShape {
    double radius = 0.5;  ///< [m], > 0
    int frequency = 10;   ///< pieces an edge of the icosahedron is cut into, >= 1: 20 frequency^2 faces
    bool operator==(const SphereShape&) const = default;
};
struct BoxShape {
    glm::dvec3 size{1.0};    ///< [m], > 0, centred on the origin
    glm::ivec3 segments{1};  ///< quads along each edge, >= 1
    bool operator==(const BoxShape&) const = default;
};
struct CapsuleShape {
    double radius = 0.25;  ///< [m], > 0
    double length = 0.5;   ///< of the straight part, along y [m], > 0
    int frequency = 8;     ///< rings over a quarter turn, >= 2
    bool operator==(const CapsuleShape&) const = default;
};
struct TextShape {
    std::string text;
    double depth = 0.2;                     ///< along z [m], > 0
    double size = 1.0;                      ///< em height [m], > 0
    std::string font = "DejaVu Sans:bold";  ///< a fontconfig pattern, or a font file
    bool operator==(const TextShape&) const = default;
};
struct FileShape {
    std::filesystem::path
        file;  ///< a surface, or ready tets; relative paths are resolved from the scene file
    bool operator==(const FileShape&) const = default;
};
using Shape = std::variant<SphereShape, BoxShape, CapsuleShape, TextShape, FileShape>;

enum class MesherKind { automatic, tetgen };

struct MesherSettings {
    MesherKind kind = MesherKind::automatic;
    double quality = 2.0;              ///< largest radius-edge ratio of a tet, > 1 (TetGen's -q)
    std::optional<double> max_volume;  ///< of a tet [m^3], > 0 (TetGen's -a)
    double time_limit = 120.0;         ///< for the mesher's process [s], > 0
    bool operator==(const MesherSettings&) const = default;
};

/// Parts of space that choose nodes, in world coordinates at the start.
struct BoxRegion {
    glm::dvec3 min, max;  ///< [m]
};
struct SphereRegion {
    glm::dvec3 center;  ///< [m]
    double radius;      ///< [m]
};
struct HalfSpaceRegion {
    glm::dvec3 normal;  ///< unit; nodes with normal . x <= offset are inside
    double offset;      ///< [m]
};
using Region = std::variant<BoxRegion, SphereRegion, HalfSpaceRegion>;

/// Where a handle is at a time, relative to where it starts.
struct Keyframe {
    double time = 0.0;     ///< [s], >= 0
    glm::dvec3 move{0.0};  ///< of the pivot [m]
    glm::dvec3 turn{0.0};  ///< about x, then y, then z [degrees]; 720 is two turns
    double scale = 1.0;    ///< away from the pivot, > 0
};

/// How a handle goes from one keyframe to the next: evenly, or slowly at both ends.
enum class Interpolation { linear, smooth };

/// How far a handle is dragged away from its keyframes, from the start on: no faster than its body can
/// follow.
struct DragDescription {
    glm::dvec3 move{0.0};  ///< [m]
    glm::dvec3 turn{0.0};  ///< about x, then y, then z [degrees]
};

/// Nodes that follow keyframes, and rest before the first and after the last.
struct HandleDescription {
    Region region;
    std::optional<glm::dvec3> pivot;  ///< about which it turns and scales [m]; empty: its nodes' centre
    Interpolation interpolation = Interpolation::linear;
    std::optional<double> release;    ///< from then on the nodes are free [s], > 0
    std::vector<Keyframe> keyframes;  ///< times ascend; the first is where the nodes start; none: they rest
    int line = 0;                     ///< in the scene file, for later messages
    DragDescription drag = {};        ///< on top of them
};

/// What a load pulls or presses with.
struct ForceLoad {
    glm::dvec3 sum{0.0};  ///< [N], shared among the region's nodes by mass
};
struct TractionLoad {
    glm::dvec3 stress{0.0};  ///< [Pa], on the faces at rest whose three nodes are in the region
};
struct PressureLoad {
    double pressure = 0.0;  ///< [Pa], inwards across the same faces as they lie now
};

struct LoadDescription {
    Region region;
    std::variant<ForceLoad, TractionLoad, PressureLoad> kind;
    std::optional<double> from = std::nullopt,
                          until = std::nullopt;  ///< when it acts [s], >= 0, from < until
    int line = 0;                                ///< in the scene file, for later messages
};

/// Tets that have this number in their file: TetGen's first attribute, Gmsh's physical group, Medit's
/// reference.
struct TetAttribute {
    int number;
};

/// A part of an object that is of a material of its own.
struct PartDescription {
    std::variant<Region, TetAttribute> where;  ///< of a region, the tets whose centroid it holds
    std::string material;                      ///< a name in Scene::materials
    int line = 0;                              ///< in the scene file, for later messages
};

/// How an object is out of shape when it starts; pinned nodes are not.
struct StartDescription {
    glm::dvec3 scale{1.0};  ///< along the world's axes, about the centre of mass, >= 0: 0 squashes it flat
    double scatter = 0.0;   ///< then each coordinate of a node moves by up to this, at random [m], >= 0
};

struct ObjectDescription {
    std::string name;
    Shape shape;
    MesherSettings mesher;
    std::string material;      ///< a name in Scene::materials
    glm::dvec3 position{0.0};  ///< [m]
    glm::dvec3 rotation{0.0};  ///< about x, then y, then z [degrees]
    double scale = 1.0;        ///< > 0, applied first
    glm::dvec3 velocity{0.0};  ///< [m/s]
    glm::dvec3 spin{0.0};      ///< angular velocity about the centre of mass [degrees/s]
    StartDescription start;
    std::vector<Region> pins;                ///< nodes in any of these stay where they are
    std::vector<HandleDescription> handles;  ///< those that move share no node with each other or a pin
    std::vector<LoadDescription> loads;
    std::optional<glm::dvec3> color;  ///< linear RGB in [0, 1]; empty: the renderer's palette
    int line = 0;                     ///< in the scene file, for later messages

    std::vector<PartDescription> parts;  ///< later ones win
};

struct PlaneCollider {
    glm::dvec3 normal{0.0, 1.0, 0.0};  ///< unit, towards the free side
    double offset = 0.0;               ///< normal . x on the plane [m]
};
struct BoxCollider {
    glm::dvec3 size{1.0};  ///< [m]
};
struct SphereCollider {
    double radius = 0.5;  ///< [m]
};
struct CapsuleCollider {
    double radius = 0.25;  ///< [m]
    double length = 0.5;   ///< of the straight part, along the collider's y [m]
};

struct ColliderDescription {
    std::variant<PlaneCollider, BoxCollider, SphereCollider, CapsuleCollider> shape;
    glm::dvec3 position{0.0};  ///< [m]; not for planes
    glm::dvec3 rotation{0.0};  ///< about x, then y, then z [degrees]; not for planes
    double friction = 0.4;     ///< CollisionSettings' where the file does not say
    double restitution = 0.3;
};

struct CameraDescription {
    glm::dvec3 eye;               ///< [m]
    glm::dvec3 target;            ///< [m]
    double field_of_view = 35.0;  ///< vertical [degrees]
};

struct Scene {
    std::filesystem::path file;  ///< where it came from; empty if it was made by a program
    SimulationSettings simulation;
    CollisionSettings collision;
    std::vector<Material> materials;
    std::vector<ObjectDescription> objects;
    std::vector<ColliderDescription> colliders;
    std::optional<CameraDescription> camera;  ///< empty: frames the scene by itself
};

/// Reads and checks a scene file. `overrides` are "section.key=value" with TOML values
/// (bare words are taken as strings), applied before the check.
/// @throws InvalidInput naming file, line, key, value and what is allowed.
Scene load_scene(const std::filesystem::path& file, const std::vector<std::string>& overrides = {});

}  // namespace gelatin
