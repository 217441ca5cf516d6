#pragma once

#include <filesystem>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "gelatin/export.h"

namespace gelatin {

/// What the user wants simulated, from a scene file or made by a program. SI units; Scene::up says which axis
/// points up. See docs/scene-files.md for the same in TOML; validate() says whether all of it can be.

enum class Axis { x, y, z };

/// Four explicit schemes, and an implicit one, stable at any step, which solves a step as one linear system
/// (docs/implicit-step.md). `vbd` is its earlier name.
enum class SolverKind { explicit_euler, semi_implicit_euler, midpoint, rk4, implicit, vbd = implicit };

constexpr bool is_implicit(SolverKind solver) {
    return solver == SolverKind::implicit;
}

/// How spring forces reach the nodes: the paper's two kernels, or one gather fused with the integration.
enum class ForceMethod { divide_and_merge, fused };

struct SimulationSettings {
    SolverKind solver = SolverKind::implicit;
    ForceMethod forces = ForceMethod::fused;
    double frame_rate = 60.0;     ///< frames a second of simulated time [1/s], > 0
    std::optional<int> substeps;  ///< steps a frame, >= 1; empty: the fewest that are stable
    int iterations = 10;          ///< of `implicit`: conjugate gradients for each linearisation at most, >= 1
    std::optional<glm::dvec3> gravity;  ///< [m/s^2]; empty: 9.81 downwards (Scene::gravity)
    int frames = 600;                   ///< length of a run, >= 0
    /// Leave bodies out while they rest; for CollisionResponse::contact.
    bool sleep = true;

    double frame_time() const { return 1.0 / frame_rate; }  ///< [s]
};

/// How faces that cannot touch are excluded before face is tested against face (docs/collision.md).
enum class BroadPhase {
    none,       ///< not at all: every face of every object against every face of every other
    boxes,      ///< the paper's: all faces of objects whose bounding boxes meet
    hierarchy,  ///< of these objects, the faces that trees of boxes find
    depth,      ///< of these objects, the faces that the depth buffer does not exclude; needs OpenGL
};

/// Whether faces are tested at the end of a step only, or during the whole step.
enum class CollisionDetection {
    discrete,    ///< the paper's: faces that overlap at the end of the step
    continuous,  ///< also those that touch during the step, each node moving along a straight line
};

/// What happens to objects whose faces touch.
enum class CollisionResponse {
    restore,  ///< the paper's (2.4): nodes return to their previous positions, and their velocities respond
    contact,  ///< bodies press each other before they touch, and never pass through each other
              ///< (docs/contact.md); for implicit solvers
};

/// How bodies of two materials, or of one, press each other; for CollisionResponse::contact.
struct MaterialPair {
    std::string first, second;  ///< names of materials, in any order
    /// Coulomb's coefficient, >= 0; empty: the geometric mean of both materials'.
    std::optional<double> friction = {};
    /// As a factor, > 0; empty: the geometric mean of both materials'.
    std::optional<double> contact_stiffness = {};
    std::optional<double> restitution = {};  ///< in [0, 1]; empty: the geometric mean of both materials'
};

struct CollisionSettings {
    BroadPhase broad_phase = BroadPhase::hierarchy;
    CollisionDetection detection = CollisionDetection::discrete;
    std::optional<CollisionResponse> response = {};  ///< empty: contact with implicit solvers, else restore
    /// Whether objects collide with themselves, too: by tests of their faces, or by contacts. Empty: where
    /// they have contacts.
    std::optional<bool> self_collision = {};
    /// Find nodes and faces, and pairs of edges, nearer than this [m], > 0; empty: off.
    std::optional<double> proximity_radius = std::nullopt;
    double friction = 0.4;                 ///< Coulomb's coefficient, >= 0
    double restitution = 0.3;              ///< normal speed after a contact relative to before, in [0, 1]
    std::vector<MaterialPair> pairs = {};  ///< each pair of materials at most once

    CollisionResponse response_with(SolverKind solver) const {
        return response.value_or(is_implicit(solver) ? CollisionResponse::contact
                                                     : CollisionResponse::restore);
    }
    bool self_collision_with(SolverKind solver) const {
        return self_collision.value_or(response_with(solver) == CollisionResponse::contact);
    }
};

/// How a material's elasticity is modelled.
enum class MaterialModel {
    mass_spring,  ///< the paper's: springs between nodes (docs/springs.md)
    neo_hookean,  ///< linear finite elements, stable neo-Hookean: any Poisson's ratio
                  ///< (docs/finite-elements.md)
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
    double poisson_ratio = 0.25;  ///< in [0, 0.49]: springs alone give 1/4, other values add a volume term.
                                  ///< Neo-Hookean: in [0, 0.5)
    double damping =
        0.0;  ///< Kelvin-Voigt relaxation time [s], >= 0: a spring's damping is damping * stiffness
    /// For mass_spring only. Empty: springs fitted to each mesh, so that the body has youngs_modulus. With
    /// kinds: the paper's springs, which are softer.
    std::optional<SpringKinds> springs;

    // Of a body's surface, for CollisionResponse::contact; the material of a part does not count.
    std::optional<double> friction = {};  ///< Coulomb's coefficient, >= 0; empty: CollisionSettings'
    /// Two surfaces begin to press at the sum of both [m], > 0; empty: a twentieth of the body's median edge.
    std::optional<double> thickness = {};
    double contact_stiffness = 1.0;          ///< of contacts, as a factor, > 0
    std::optional<double> restitution = {};  ///< in [0, 1]; empty: CollisionSettings'
    int line = 0;                            ///< in the scene file, for later messages
};

struct SphereShape {
    double radius = 0.5;  ///< [m], > 0
    int frequency = 10;   ///< number of pieces of each edge of an icosahedron, >= 1: 20 frequency^2 faces
    bool operator==(const SphereShape&) const = default;
};
struct BoxShape {
    glm::dvec3 size{1.0};    ///< [m], > 0, centred on the origin
    glm::ivec3 segments{1};  ///< quads along each edge, >= 1
    bool operator==(const BoxShape&) const = default;
};
struct CapsuleShape {
    double radius = 0.25;  ///< [m], > 0
    double length = 0.5;   ///< of the straight part, upright [m], > 0
    int frequency = 8;     ///< rings on a hemisphere, >= 2
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
    std::filesystem::path file;  ///< a surface or a tet mesh; a relative path is relative to the scene file
    bool operator==(const FileShape&) const = default;
};
/// A mesh in memory: a surface, or tets.
struct Mesh {
    std::vector<glm::dvec3> vertices;   ///< [m], finite
    std::vector<glm::uvec3> triangles;  ///< of a surface, counter-clockwise from outside; or
    std::vector<glm::uvec4> tets;       ///< none of them flat
    std::vector<int> attributes;        ///< of the tets, for TetAttribute, shape [tets]; empty: none
};
/// Treated as the same mesh in a file: a surface is repaired and filled by the mesher, with its skin; tets
/// are used as they are. Scene files cannot contain it.
struct MeshShape {
    std::shared_ptr<const Mesh> mesh;                   ///< not null; must not change any more
    bool operator==(const MeshShape&) const = default;  ///< whether it is the same one in memory
};
using Shape = std::variant<SphereShape, BoxShape, CapsuleShape, TextShape, FileShape, MeshShape>;

/// How a surface is filled with tets.
enum class MesherKind {
    automatic,  ///< by TetGen, or by the lattice where that fails or is finer than wanted; a line says so
    tetgen,     ///< by TetGen: tets of a closed surface, with its vertices and edges
    lattice,    ///< by a lattice that is cut along the surface: any surface that encloses something, also a
                ///< broken one
};

struct MesherSettings {
    MesherKind kind = MesherKind::automatic;
    double quality = 2.0;       ///< of tetgen: largest radius-edge ratio of a tet, > 1 (its -q)
    double time_limit = 120.0;  ///< of tetgen's process [s], > 0

    // Of these one at most. Without any, surfaces from files and lattices get about 5000 nodes; TetGen makes
    // as few of other surfaces as their triangles and `quality` need.
    std::optional<int> nodes = {};          ///< within 20%, from 10 to 1000000
    std::optional<double> max_volume = {};  ///< of a tet [m^3], > 0
    std::optional<double> cell_size = {};   ///< of the lattice: edge of its cells at the surface [m], > 0

    bool has_size() const { return nodes || max_volume || cell_size; }
    bool operator==(const MesherSettings&) const = default;
};

/// Parts of space that select nodes, faces or tets, in world coordinates at the start.
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

/// The placement of a handle at one time, relative to the start.
struct Keyframe {
    double time = 0.0;     ///< [s], >= 0
    glm::dvec3 move{0.0};  ///< displacement of the pivot [m]
    glm::dvec3 turn{0.0};  ///< rotation about x, then y, then z [degrees]; 720 is two full rotations
    double scale = 1.0;    ///< about the pivot, > 0
};

/// How a handle moves between keyframes: at constant speed, or starting and ending at rest.
enum class Interpolation { linear, smooth };

/// What a handle or a collider does while bodies leave it no room to follow its keyframes. It waits, and
/// pushes nothing through anything; a warning names it. For CollisionResponse::contact.
enum class WhenBlocked {
    goes_on,  ///< the time of its keyframes goes on: it catches up as soon as it can
    stops,    ///< its time stands still, so that all that it has still to do follows later
};

/// A clip of a glTF file. It moves nodes, bones of skins and morph targets.
struct AnimationClip {
    std::string name = {};  ///< empty: the file's first
};
/// A sequence of files, one after the other, each with all vertices in the same order.
struct AnimationFiles {
    std::filesystem::path pattern;  ///< `*` stands for anything in the last part; taken in order of numbers
    double rate = 24.0;             ///< files a second [1/s], > 0
};
/// The vertices at even times, in memory.
struct AnimationFrames {
    /// [m], shape [frames, vertices]
    std::shared_ptr<const std::vector<std::vector<glm::dvec3>>> frames;
    double rate = 24.0;  ///< frames a second [1/s], > 0
};
/// A program says where they are, while the scene runs: Simulator::set_collider_vertices.
struct AnimationByProgram {};

/// How the vertices of a shape move, before it is placed in the scene. Nothing breaks their surface.
struct AnimationDescription {
    std::variant<AnimationClip, AnimationFiles, AnimationFrames, AnimationByProgram> source = {};
    /// When it begins [s], >= 0. Until then a clip's nodes go from where the file has them to where the clip
    /// begins.
    double start = 0.0;
    double speed = 1.0;  ///< > 0
    bool loop = false;   ///< begins again when it ends; otherwise it stays where it ends
};

/// Bones of a glTF file, which move nodes near them, each those to which it is nearest: joints of skins, or
/// all nodes where there are none, with what is between them.
struct SkeletonDescription {
    std::filesystem::path file;       ///< .gltf or .glb; placed as the object is
    double radius = 0.0;              ///< nodes nearer to a bone than this follow it [m], > 0
    std::string clip = {};            ///< its name; empty: the file's first
    double start = 0.0, speed = 1.0;  ///< as of AnimationDescription
    bool loop = false;
};

/// A drag in addition to a handle's keyframes. The handle approaches it from the start on, no faster than its
/// body can follow.
struct DragDescription {
    glm::dvec3 move{0.0};  ///< displacement [m]
    glm::dvec3 turn{0.0};  ///< rotation about x, then y, then z [degrees]
};

/// Nodes that follow keyframes. They are at rest before the first and after the last.
struct HandleDescription {
    Region region;
    std::optional<glm::dvec3>
        pivot;  ///< point about which it rotates and scales [m]; empty: its nodes' centre
    Interpolation interpolation = Interpolation::linear;
    std::optional<double> release;    ///< time from which the nodes are free [s], > 0
    std::vector<Keyframe> keyframes;  ///< in ascending order of time; the first is the start; none: a pin
    int line = 0;                     ///< in the scene file, for later messages
    DragDescription drag = {};        ///< in addition to the keyframes
    /// With `stops` its release is later, too. Then it needs keyframes or a skeleton, and
    /// CollisionResponse::contact.
    WhenBlocked when_blocked = WhenBlocked::goes_on;
    /// In place of the region: its nodes are those near bones, which move them in addition to the keyframes.
    std::optional<SkeletonDescription> skeleton = {};
};

/// The kinds of load.
struct ForceLoad {
    glm::dvec3 sum{0.0};  ///< [N], distributed over the region's nodes by mass
};
struct TractionLoad {
    glm::dvec3 stress{0.0};  ///< [Pa], on the rest area of faces whose three nodes are in the region
};
struct PressureLoad {
    double pressure = 0.0;  ///< [Pa], inwards, perpendicular to the same faces as deformed
};

struct LoadDescription {
    Region region;
    std::variant<ForceLoad, TractionLoad, PressureLoad> kind;
    std::optional<double> from = std::nullopt,
                          until = std::nullopt;  ///< when it acts [s], >= 0, from < until
    int line = 0;                                ///< in the scene file, for later messages
};

/// Tets that have this number in Mesh::attributes, or in their file: TetGen's first attribute, Gmsh's
/// physical group, Medit's reference.
struct TetAttribute {
    int number;
};

/// A part of an object with its own material.
struct PartDescription {
    std::variant<Region, TetAttribute> where;  ///< a region selects the tets whose centroid is in it
    std::string material;                      ///< a name in Scene::materials
    int line = 0;                              ///< in the scene file, for later messages
};

/// The deformation of an object at the start; pinned nodes stay at rest.
struct StartDescription {
    glm::dvec3 scale{1.0};  ///< along the world's axes, about the centre of mass, >= 0; 0 flattens it
    double scatter = 0.0;   ///< then a random displacement of each coordinate by up to this [m], >= 0
};

/// How the gas in a cavity presses.
enum class GasLaw {
    sealed,    ///< by its volume, at the same temperature: what is in it stays
    constant,  ///< at a regulated gauge pressure
};

/// What a cavity has instead: the pressure of GasLaw::constant, or the amount of GasLaw::sealed.
struct CavityGas {
    std::optional<double> pressure = {}, amount = {};  ///< as of CavityDescription; one of both
};

/// The same at one time: linear in between, constant before the first and after the last.
struct CavityKeyframe {
    double time = 0.0;                                 ///< [s], >= 0
    std::optional<double> pressure = {}, amount = {};  ///< as of CavityGas
};

/// Gas in a hollow of a deformable object; for SolverKind::implicit (docs/cavities.md).
struct CavityDescription {
    std::string name = {};  ///< in statistics; empty: "cavity 1", by its place in the object
    /// The hollow whose surface has all of its nodes in it. Empty: the only one that the object has.
    std::optional<Region> region = {};
    GasLaw law = GasLaw::sealed;
    double pressure = 0.0;      ///< at the hollow's volume at rest, above the ambient one [Pa]
    double amount = 1.0;        ///< of a sealed gas, as a factor of what has this pressure, > 0
    double ambient = 101325.0;  ///< pressure outside [Pa], > 0
    std::vector<CavityKeyframe> keyframes = {};  ///< in ascending order of time
    int line = 0;                                ///< in the scene file, for later messages
};

/// What a rigid object has where its shape and the density of its material do not say it.
struct RigidDescription {
    std::optional<double> mass = {};  ///< [kg], > 0; empty: by density
    /// About the centre of mass, along the axes of the shape before it is rotated [kg m^2]: > 0, and none
    /// more than both others together. Empty: as for an even density.
    std::optional<glm::dvec3> inertia = {};
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

    /// Draws and exports the shape's own surface where it is not the boundary of the tets; false: this
    /// boundary, with which it collides.
    bool skin = true;

    /// The axis of the shape that points up in the scene before it is rotated. Empty: the scene's up axis
    /// for boxes, meshes and files; y for glTF files, which have it so, and for the other shapes: capsules
    /// and texts stand upright.
    std::optional<Axis> up = {};

    int pins_line = 0;  ///< of `pins`, as `line`

    /// A rigid body of the shape's closed surface, for SolverKind::implicit. Of its material density,
    /// friction, thickness, contact_stiffness and restitution count; it has no mesher, start, parts, pins and
    /// handles. Empty: the object is deformable.
    std::optional<RigidDescription> rigid = {};

    std::vector<CavityDescription> cavities = {};  ///< with different names, of different hollows
};

struct PlaneCollider {
    glm::dvec3 normal{0.0, 1.0, 0.0};  ///< unit, towards the free side; a z-up floor's is z
    double offset = 0.0;               ///< normal . x on the plane [m]
};

/// What bodies cannot enter. With CollisionResponse::contact every shape but a plane is a rigid surface with
/// two sides, open ones too. Otherwise spheres, boxes and capsules are solid, and others are not possible.
struct ColliderDescription {
    std::variant<PlaneCollider, Shape> shape;
    glm::dvec3 position{0.0};  ///< [m]; this, rotation and scale are not for planes
    glm::dvec3 rotation{0.0};  ///< about x, then y, then z [degrees]
    double friction = 0.4;     ///< CollisionSettings' where the file does not say
    double restitution = 0.3;

    // For CollisionResponse::contact, and not for planes:
    /// In ascending order of time; the first is the start; none: it rests.
    std::vector<Keyframe> keyframes = {};
    Interpolation interpolation = Interpolation::linear;
    std::optional<glm::dvec3> pivot = {};  ///< about which it rotates and scales [m]; empty: its position
    glm::dvec3 surface_velocity{0.0};      ///< of the surface within itself, as of a belt [m/s]
    /// In messages and statistics; no two colliders have the same; empty: "collider 1", by its place.
    std::string name = {};
    double scale = 1.0;                               ///< > 0, applied first
    WhenBlocked when_blocked = WhenBlocked::goes_on;  ///< `stops` needs keyframes or an animation
    std::optional<Axis> up = {};                      ///< as ObjectDescription::up; not for planes
    /// In addition to keyframes; empty: its shape does not change.
    std::optional<AnimationDescription> animation = {};
    int line = 0;  ///< in the scene file, for later messages
};

/// A ball joint. The point moves with what is there of both sides.
struct AttachedPoint {
    glm::dvec3 at;  ///< [m], at the start
};
/// A hinge: all points of a line segment. Between rigid sides it has a coordinate: the angle by which the
/// object has rotated beside the other side, about the direction from the first point to the second.
struct AttachedLine {
    glm::dvec3 from, to;  ///< [m], at the start
};
/// A slider: the object does not rotate beside the other side, and moves along the direction from the first
/// point to the second. How far it has moved is its coordinate. Both sides are rigid.
struct AttachedRail {
    glm::dvec3 from, to;  ///< [m], at the start
};
/// A universal joint: a point that is kept, and two axes that stay perpendicular. Both sides are rigid.
struct AttachedUniversal {
    glm::dvec3 at;        ///< [m], at the start
    glm::dvec3 own;       ///< the axis that moves with the object, at the start; of any length
    glm::dvec3 of_other;  ///< the one that moves with the other side; within 1 degree of perpendicular
};
/// A rod or a rope between two points. Their distance is its coordinate: without limits, spring and motor it
/// stays what it is.
struct AttachedDistance {
    glm::dvec3 from;  ///< on the object [m], at the start
    glm::dvec3 to;    ///< on the other side, another point
};

/// Pulls a joint to where it rests. The unit of angles is degrees, but here: N m/rad, N m s/rad.
struct JointSpring {
    double stiffness = 0.0;           ///< [N m/rad] or [N/m], >= 0
    double damping = 0.0;             ///< [N m s/rad] or [N s/m], >= 0
    std::optional<double> rest = {};  ///< [degrees] or [m]; empty: where the joint is at the start
};

/// From a time on, until the next one: what a motor does otherwise. What is empty stays as it was.
struct MotorKeyframe {
    double time = 0.0;                                            ///< [s], >= 0
    std::optional<double> speed = {}, position = {}, force = {};  ///< as of JointMotor
};

/// Moves a joint at a speed, or to a position; at least one of them is given. It holds it there, too.
struct JointMotor {
    /// [degrees/s] or [m/s]. Where there is a position, it goes there no faster than that.
    std::optional<double> speed = {};
    std::optional<double> position = {};        ///< [degrees] or [m]
    std::optional<double> force = {};           ///< the greatest [N m] or [N], >= 0; empty: whatever it takes
    std::vector<MotorKeyframe> keyframes = {};  ///< in ascending order of time
};

/// Keeps points of an object where they are in another one, in a collider, or in space. Where it is glued,
/// surfaces do not press each other. For SolverKind::implicit.
struct AttachmentDescription {
    std::string name = {};  ///< in messages; empty: "attachment 1", by its place in the scene
    std::string object;     ///< a name in Scene::objects
    std::string to = {};    ///< another object's name, or a collider's; empty: where it is in space
    /// Which points: of a region, the object's nodes in it. None: its nodes within what it is attached to, or
    /// nearer to it than half of its median edge.
    std::variant<std::monostate, Region, AttachedPoint, AttachedLine, AttachedRail, AttachedUniversal,
                 AttachedDistance>
        where = {};
    double compliance = 0.0;  ///< of the whole attachment [m/N], >= 0; 0: as stiff as the bodies
    std::optional<double> break_force = {};  ///< at which it breaks [N], > 0; empty: never
    /// Of joints with a coordinate: AttachedLine between rigid sides, AttachedRail, AttachedDistance.
    /// Least and greatest coordinate [degrees] or [m]: of a line from -180 to 180; the start is among them.
    std::optional<glm::dvec2> limits = {};
    std::optional<JointSpring> spring = {};
    std::optional<JointMotor> motor = {};
    int line = 0;  ///< in the scene file, for later messages
};

struct CameraDescription {
    glm::dvec3 eye;               ///< [m]
    glm::dvec3 target;            ///< [m]
    double field_of_view = 35.0;  ///< vertical [degrees]
};

struct SceneMeshes;

struct Scene {
    std::filesystem::path file;  ///< where it came from; empty if it was made by a program
    SimulationSettings simulation;
    CollisionSettings collision;
    std::vector<Material> materials;
    std::vector<ObjectDescription> objects;
    std::vector<ColliderDescription> colliders;
    std::vector<AttachmentDescription> attachments;
    std::optional<CameraDescription> camera;  ///< empty: frames the scene by itself
    /// Meshes that were made of its shapes before, and are used for these: those of a recording. Null: none.
    std::shared_ptr<const SceneMeshes> meshes = {};
    /// y or z: which way gravity does not pull, what is up in pictures, and how shapes stand. All coordinates
    /// in and out are those of the scene.
    Axis up = Axis::y;

    glm::dvec3 up_direction() const {
        return {up == Axis::x ? 1.0 : 0.0, up == Axis::y ? 1.0 : 0.0, up == Axis::z ? 1.0 : 0.0};
    }
    glm::dvec3 gravity() const { return simulation.gravity.value_or(-9.81 * up_direction()); }
    bool has_contact() const {
        return collision.response_with(simulation.solver) == CollisionResponse::contact;
    }
};

/// Reads and checks a scene file. `overrides` are "section.key=value" with TOML values
/// (bare words are taken as strings), applied before the check.
/// @throws InvalidInput naming file, line, key, value and what is allowed.
GELATIN_API Scene load_scene(const std::filesystem::path& file,
                             const std::vector<std::string>& overrides = {});

/// Checks every value of a scene, however it was made: numbers finite and in range, names there and free,
/// materials that exist, settings that go together. Simulator does so by itself.
/// @throws InvalidInput naming field, value and what is allowed, as load_scene does
GELATIN_API void validate(const Scene& scene);

}  // namespace gelatin
