#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "model/collision/rest_shape.h"
#include "model/drive/cavity.h"
#include "model/drive/handles.h"
#include "model/drive/loads.h"
#include "model/elasticity/neo_hookean.h"
#include "model/elasticity/node_tets.h"
#include "model/elasticity/volume_term.h"
#include "model/layouts.h"
#include "model/range.h"
#include "model/shared_constants.h"
#include "model/skin.h"

namespace gelatin {

/// How a body presses others. @see Material
struct BodySurface {
    std::string material;
    std::optional<double> friction, thickness, restitution;
    double contact_stiffness = 1.0;
};

/// One deformable body, or the rigid surface of a collider: its ranges in the packed arrays, and its constant
/// properties.
struct ModelObject {
    std::string name;
    Range nodes, springs, faces, tets, handle_nodes;
    Range neo_hookean_tets;    ///< all of its tets, or none
    Range cavities;            ///< in Model::cavities
    bool is_rigid = false;     ///< a body without springs and tets; its last four nodes are on no face
    double mass = 0.0;         ///< [kg]
    double rest_volume = 0.0;  ///< [m^3]
    glm::vec3 color{0.0f};     ///< linear RGB; negative if the scene gives none
    BodySurface surface;       ///< of a body

    /// Without those four, which have a rigid body's mass, and with a large inertia are outside of it.
    Range shape_nodes() const { return {nodes.first, is_rigid ? nodes.count - 4 : nodes.count}; }
};

/// What a collider's surface has besides its nodes and faces. It has no springs, tets and mass, and all of
/// its nodes are held.
struct RigidSurface {
    double friction = 0.0;     ///< Coulomb's coefficient
    double restitution = 0.0;  ///< as of ColliderDescription
    glm::vec3 velocity{0.0f};  ///< of the surface within itself [m/s]
    bool moves = false;        ///< by a handle
    bool deforms = false;      ///< its handle is animated
};

/// Half springs by node, in slices of 64 nodes (sliced ELLPACK; a slice is a work group). Pair p of node 64 s
/// + l is element slice_starts[s] + 64 p + l. So neighbouring invocations read neighbouring texels, and all
/// rows of a slice have the same number of iterations.
struct HalfSprings {
    static constexpr std::uint32_t kSlice = packing::kSlice;

    std::vector<std::uint32_t> slice_starts;  ///< shape [slices + 1]
    std::vector<HalfSpringPair> pairs;        ///< shape [slice_starts.back()]
    std::vector<glm::vec2> stiffness;         ///< [N/m], shape [slice_starts.back()]
};

/// Springs by node for the paper's merge: entries of node n are starts[n] .. starts[n+1]; an entry is 2 *
/// spring, plus 1 if the node is the spring's second endpoint.
struct SpringIncidence {
    std::vector<std::uint32_t> starts;   ///< shape [nodes + 1]
    std::vector<std::uint32_t> entries;  ///< shape [2 * springs]
};

/// A tet's properties at rest.
struct TetRest {
    float volume;   ///< [m^3], > 0
    float modulus;  ///< modulus of its resistance to being flat [Pa]: Young's; 0 for neo-Hookean tets
    float bulk;     ///< bulk modulus of its springs, or of itself [Pa], > 0
    float kappa;    ///< additional stiffness of the volume term (model/elasticity/volume_term.h) [Pa]
};

/// Faces by node: those of node n are faces[starts[n]] .. faces[starts[n + 1]], ascending; none inside.
struct NodeFaces {
    std::vector<std::uint32_t> starts;  ///< shape [nodes + 1]
    std::vector<std::uint32_t> faces;   ///< indices into Model::faces, shape [3 * faces]
};

/// The surface's nodes and edges, each once. The first face that has one owns it, and they are in the order
/// of their owners. So those of a leaf of a tree, whose faces are contiguous, are contiguous too. An edge may
/// have one face, two, or more.
struct SurfaceParts {
    std::vector<std::uint32_t> nodes;
    std::vector<FaceEdge> edges;
    std::vector<glm::uvec2> face_starts;  ///< of each face in nodes and in edges, and the ends: [faces + 1]
};

/// The topology of trees of boxes, which never changes: up to four children for each node, up to four items
/// in a leaf. Nodes come before their children. A walk continues with the next node, or with `skip` to leave
/// out the subtree.
struct BoxTree {
    static constexpr std::uint32_t kLeafItems = 4;

    std::vector<TreeNode> nodes;
    std::vector<std::uint32_t> roots;                ///< of each tree
    std::vector<std::vector<std::uint32_t>> levels;  ///< nodes by height; leaves first
};

/// All objects of a scene, packed (paper 3.2) and immutable; shared by every backend.
///
/// An object owns a contiguous range of each array. Nodes are ordered for locality within their object.
struct Model {
    std::vector<ModelObject> objects;           ///< bodies, then the surfaces of colliders
    std::vector<RigidSurface> surfaces;         ///< of the last objects
    std::shared_ptr<const SceneMeshes> meshes;  ///< of the scene's shapes; null: it was not made of a scene

    std::vector<glm::vec4> positions;  ///< at the start: xyz [m], inverse mass [1/kg] (0 pins), shape [nodes]
    std::vector<glm::vec4>
        velocities;             ///< at the start: xyz [m/s], damping time [s] of the material, shape [nodes]
    std::vector<float> masses;  ///< [kg], > 0, pinned nodes too, shape [nodes]
    std::vector<std::uint32_t> node_objects;  ///< the object of each, shape [nodes]

    std::vector<Spring> springs;
    HalfSprings half_springs;
    SpringIncidence incidence;

    std::vector<glm::uvec4> tets;                 ///< shape [tets]
    std::vector<TetRest> tet_rests;               ///< shape [tets]
    std::vector<float> shear_moduli;              ///< of the tets' materials [Pa], shape [tets]
    VolumeTerm volume_term;                       ///< empty where springs and tets need none
    std::vector<NeoHookeanTet> neo_hookean_tets;  ///< of the bodies that have no springs
    NodeTets neo_hookean_corners;                 ///< by node; empty where there are none
    std::vector<Face> faces;                      ///< boundary triangles, shape [faces]
    NodeFaces node_faces;
    SurfaceParts surface_parts;
    BoxTree face_trees;      ///< one an object
    RestShapes rest_shapes;  ///< empty where objects do not collide with themselves
    DrawSurface surface;     ///< over `faces`
    Skin skin;               ///< empty where this is all that there is to draw

    std::vector<Handle> handles;           ///< and pins, object by object: an object's handles, then its pins
    std::vector<HandleNode> handle_nodes;  ///< in the same order
    Loads loads;
    std::vector<Cavity> cavities;  ///< object by object

    std::vector<Collider> colliders;  ///< in the order of their kinds
    glm::vec3 gravity{0.0f};          ///< [m/s^2]

    std::uint32_t node_count() const { return static_cast<std::uint32_t>(positions.size()); }
    std::size_t body_count() const { return objects.size() - surfaces.size(); }
    std::span<const ModelObject> bodies() const { return {objects.data(), body_count()}; }
    bool is_body(std::size_t object) const { return object < body_count(); }
    bool has_rigid_bodies() const;
    /// Those of bodies come first.
    std::uint32_t body_node_count() const {
        return body_count() > 0 ? objects[body_count() - 1].nodes.end() : 0;
    }
    bool has_damping() const;
};

/// Model::node_objects
std::vector<std::uint32_t> objects_of_nodes(const Model& model);

/// Of each node its place in SurfaceParts::nodes, or kNoNode inside a body.
std::vector<std::uint32_t> places_on_surface(const Model& model);

}  // namespace gelatin
