#include "model/assembly/build_model.h"

#include <fmt/core.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <filesystem>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <limits>
#include <numeric>
#include <span>
#include <utility>
#include <variant>

#include "core/progress.h"
#include "gelatin/error.h"
#include "mesh/surface_repair.h"
#include "mesh/topology.h"
#include "model/assembly/body_handles.h"
#include "model/assembly/cavities.h"
#include "model/assembly/draw_surface.h"
#include "model/assembly/object_mesh.h"
#include "model/assembly/pack_skin.h"
#include "model/assembly/tet_materials.h"
#include "model/collision/box_tree.h"
#include "model/collision/node_faces.h"
#include "model/collision/pack_colliders.h"
#include "model/collision/surface_parts.h"
#include "model/drive/check_regions.h"
#include "model/elasticity/neo_hookean.h"
#include "model/elasticity/volume_term.h"
#include "model/region.h"
#include "model/setting_names.h"
#include "model/spring_packing.h"
#include "model/springs/spring_moduli.h"
#include "model/springs/springs.h"
#include "model/transform.h"

namespace gelatin {
namespace {

// Sorting all nodes of a small object by degree evens out the slices. In a large object it would destroy
// locality.
constexpr std::size_t kSmallObject = 8192;
constexpr std::uint32_t kSortWindow = 256;

// A body's mesh with its nodes in an order that keeps neighbours near each other.
struct Arranged {
    TetMesh mesh;
    std::vector<std::uint32_t> new_index;  // by the node's previous index
    std::vector<std::size_t> old_tets;     // each tet's previous index
};

// The last ones may have to stay last.
Arranged arranged(const TetMesh& mesh, const std::vector<glm::uvec2>& edges, std::uint32_t last) {
    const Graph graph = make_graph(mesh.positions.size(), edges);
    const auto count = static_cast<std::uint32_t>(mesh.positions.size());
    std::vector<std::uint32_t> order = locality_order(graph, count <= kSmallObject ? count : kSortWindow);
    std::stable_partition(order.begin(), order.end(), [&](std::uint32_t n) { return n < count - last; });

    std::vector<std::uint32_t> new_index(count);
    for (std::uint32_t n = 0; n < count; ++n) new_index[order[n]] = n;
    TetMesh result;
    for (const std::uint32_t old : order) result.positions.push_back(mesh.positions[old]);
    const auto renamed = [&](const glm::uvec4& t) {
        return glm::uvec4(new_index[t.x], new_index[t.y], new_index[t.z], new_index[t.w]);
    };
    const auto least_node = [&](std::size_t tet) {
        const glm::uvec4 t = renamed(mesh.tets[tet]);
        return std::min(std::min(t.x, t.y), std::min(t.z, t.w));
    };
    std::vector<std::size_t> old_tets(mesh.tets.size());
    std::iota(old_tets.begin(), old_tets.end(), std::size_t{0});
    std::stable_sort(old_tets.begin(), old_tets.end(),
                     [&](std::size_t a, std::size_t b) { return least_node(a) < least_node(b); });
    for (const std::size_t old : old_tets) result.tets.push_back(renamed(mesh.tets[old]));
    for (const glm::uvec3& f : mesh.faces)
        result.faces.emplace_back(new_index[f.x], new_index[f.y], new_index[f.z]);
    arrange_faces(result.positions, result.faces);
    return {std::move(result), std::move(new_index), std::move(old_tets)};
}

float checked_float(double value, const std::string& object, const char* what) {
    if (value > 0.0 && value >= std::numeric_limits<float>::min() &&
        value <= std::numeric_limits<float>::max()) {
        return static_cast<float>(value);
    }
    throw InvalidInput(
        {{},
         0,
         "object '" + object + "'",
         {},
         fmt::format("{} is {:.3g}, beyond what single precision holds; check density, scale and stiffness",
                     what, value)});
}

void append_nodes(Model& model, const Body& body, const Arranged& arranged) {
    const TetMesh& mesh = arranged.mesh;
    std::vector<double> masses(mesh.positions.size(), 0.0), damping(masses);
    for (std::size_t n = 0; n < body.rigid_masses.size(); ++n)
        masses[arranged.new_index[n]] = body.rigid_masses[n];
    for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
        const Material& material = body.material_of(arranged.old_tets[t]);
        const double quarter = 0.25 * material.density * tet_volume(mesh, mesh.tets[t]);
        for (int k = 0; k < 4; ++k) {
            masses[mesh.tets[t][k]] += quarter;
            damping[mesh.tets[t][k]] += quarter * material.damping;
        }
    }
    glm::dvec3 center(0.0);  // of mass
    double sum = 0.0;
    for (std::size_t n = 0; n < masses.size(); ++n) {
        center += masses[n] * mesh.positions[n];
        sum += masses[n];
    }
    center /= sum;
    const bool has_parts = !body.tet_materials.empty();
    for (std::size_t n = 0; n < mesh.positions.size(); ++n) {
        const float mass = checked_float(masses[n], body.name, "a node's mass [kg]");
        const glm::dvec3 velocity = body.velocity + glm::cross(body.spin, mesh.positions[n] - center);
        model.positions.emplace_back(glm::vec3(mesh.positions[n]), 1.0f / mass);
        model.velocities.emplace_back(
            glm::vec3(velocity),
            static_cast<float>(has_parts ? damping[n] / masses[n] : body.material.damping));
        model.masses.push_back(mass);
    }
}

// Pairs of nodes that exert forces on each other, by the body mesh's indices.
std::vector<glm::uvec2> joined_nodes(const Body& body, const FittedSprings* fitted) {
    if (body.has_neo_hookean_tets()) return tet_edges(body.mesh.tets);
    std::vector<glm::uvec2> nodes;
    if (body.is_rigid()) {  // which are near each other
        for (const glm::uvec3& f : body.mesh.faces)
            for (int k = 0; k < 3; ++k)
                if (f[k] < f[(k + 1) % 3]) nodes.emplace_back(f[k], f[(k + 1) % 3]);
        return nodes;
    }
    if (fitted != nullptr) {
        for (const UnitSpring& spring : fitted->springs) nodes.push_back(spring.nodes);
    } else {
        for (const Spring& spring : make_springs(body.mesh, *body.material.springs, 1.0))
            nodes.emplace_back(spring.i, spring.j);
    }
    return nodes;
}

// Fitted springs for the body's material and size, in ascending order of nodes.
std::vector<Spring> scaled_springs(const Body& body, const Arranged& arranged, const FittedSprings& fitted) {
    const double mu = shear_modulus(body.material);
    std::vector<Spring> springs;
    for (const UnitSpring& unit : fitted.springs) {
        const std::uint32_t a = arranged.new_index[unit.nodes.x], b = arranged.new_index[unit.nodes.y];
        const double length = glm::distance(arranged.mesh.positions[a], arranged.mesh.positions[b]);
        const double stiffness = mu * body.scale * unit.stiffness;
        springs.push_back(
            {std::min(a, b), std::max(a, b), static_cast<float>(length), static_cast<float>(stiffness)});
    }
    std::sort(springs.begin(), springs.end(),
              [](const Spring& a, const Spring& b) { return a.i != b.i ? a.i < b.i : a.j < b.j; });
    return springs;
}

// Scales springs from the stiffness of the body's own material to that of its parts.
void adapt_to_parts(const Body& body, const Arranged& arranged, std::vector<Spring>& springs) {
    if (body.tet_materials.empty()) return;
    std::vector<double> tet_moduli;
    for (const std::size_t old : arranged.old_tets)
        tet_moduli.push_back(shear_modulus(body.material_of(old)));
    std::vector<glm::uvec2> nodes;
    for (const Spring& spring : springs) nodes.emplace_back(spring.i, spring.j);
    const std::vector<double> moduli = spring_moduli(arranged.mesh, tet_moduli, nodes);
    for (std::size_t s = 0; s < springs.size(); ++s) {
        const double factor = moduli[s] / shear_modulus(body.material);
        springs[s].stiffness = static_cast<float>(factor * static_cast<double>(springs[s].stiffness));
    }
}

std::vector<Spring> springs_of(const Body& body, const Arranged& arranged, const FittedSprings* fitted) {
    std::vector<Spring> springs = fitted != nullptr
                                      ? scaled_springs(body, arranged, *fitted)
                                      : make_springs(arranged.mesh, *body.material.springs,
                                                     shear_modulus(body.material) / kShearOverYoungs);
    adapt_to_parts(body, arranged, springs);
    return springs;
}

void append_springs(Model& model, const std::vector<Spring>& springs, const std::string& object,
                    std::uint32_t first_node) {
    for (Spring spring : springs) {
        checked_float(static_cast<double>(spring.stiffness), object, "a spring's stiffness [N/m]");
        spring.i += first_node;
        spring.j += first_node;
        model.springs.push_back(spring);
    }
}

NeoHookeanModuli moduli_of(const Material& material) {
    return neo_hookean_moduli(material.youngs_modulus, material.poisson_ratio);
}

void append_neo_hookean_tets(Model& model, const Body& body, const Arranged& arranged,
                             std::uint32_t first_node) {
    const std::vector<glm::dvec3>& positions = arranged.mesh.positions;
    for (std::size_t t = 0; t < arranged.mesh.tets.size(); ++t) {
        const NeoHookeanModuli moduli = moduli_of(body.material_of(arranged.old_tets[t]));
        checked_float(moduli.mu, body.name, "a tet's mu [Pa]");
        checked_float(moduli.lambda + moduli.kappa, body.name, "a tet's lambda [Pa]");
        const glm::uvec4& tet = arranged.mesh.tets[t];
        model.neo_hookean_tets.push_back(make_neo_hookean_tet(
            tet + first_node, {positions[tet.x], positions[tet.y], positions[tet.z], positions[tet.w]},
            moduli));
    }
}

NodeTets make_neo_hookean_corners(const Model& model) {
    std::vector<glm::uvec4> nodes;
    for (const NeoHookeanTet& tet : model.neo_hookean_tets) nodes.push_back(nodes_of(tet));
    return nodes.empty() ? NodeTets() : make_node_tets(model.node_count(), nodes);
}

// Of the object that comes next.
Range append_cavities(const std::vector<Cavity>& cavities, std::span<const std::uint32_t> new_index,
                      std::uint32_t first_node, Model& model) {
    const Range range{static_cast<std::uint32_t>(model.cavities.size()),
                      static_cast<std::uint32_t>(cavities.size())};
    for (Cavity cavity : cavities) {
        cavity.object = static_cast<std::uint32_t>(model.objects.size());
        for (glm::uvec3& face : cavity.faces)
            for (int k = 0; k < 3; ++k) face[k] = first_node + new_index[face[k]];
        model.cavities.push_back(std::move(cavity));
    }
    return range;
}

// Null if the material names the paper's springs, or has none.
std::shared_ptr<const FittedSprings> fitted_springs(const Body& body) {
    if (!body.has_springs() || body.material.springs) return nullptr;
    return body.fitted ? body.fitted : std::make_shared<const FittedSprings>(fit_springs(body.mesh));
}

// Returns where the nodes of the body's mesh are now, from the object's first.
std::vector<std::uint32_t> append_body(Model& model, const Body& body) {
    const auto size = [](const auto& array) { return static_cast<std::uint32_t>(array.size()); };
    const std::shared_ptr<const FittedSprings> fitted = fitted_springs(body);
    Arranged order = arranged(body.mesh, joined_nodes(body, fitted.get()), body.is_rigid() ? 4 : 0);
    const TetMesh& mesh = order.mesh;

    ModelObject object;
    object.name = body.name;
    object.color = body.color;
    object.surface = {body.material.name, body.material.friction, body.material.thickness,
                      body.material.restitution, body.material.contact_stiffness};
    object.nodes = {size(model.positions), size(mesh.positions)};
    object.tets = {size(model.tets), size(mesh.tets)};
    object.faces = {size(model.faces), size(mesh.faces)};
    object.springs.first = size(model.springs);

    const std::uint32_t first = object.nodes.first;
    append_nodes(model, body, order);
    object.handle_nodes.first = size(model.handle_nodes);
    append_handles(body, mesh.positions, first, model);
    object.handle_nodes.count = size(model.handle_nodes) - object.handle_nodes.first;
    append_loads(body.loads, mesh, std::span(model.masses).subspan(first), first, model.loads);
    object.cavities = append_cavities(body.cavities, order.new_index, first, model);
    if (body.has_springs()) append_springs(model, springs_of(body, order, fitted.get()), body.name, first);
    object.springs.count = size(model.springs) - object.springs.first;
    object.is_rigid = body.is_rigid();
    object.mass = std::accumulate(body.rigid_masses.begin(), body.rigid_masses.end(), 0.0);
    object.rest_volume = body.rigid_volume;
    for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
        const Material& material = body.material_of(order.old_tets[t]);
        const double volume = tet_volume(mesh, mesh.tets[t]);
        object.rest_volume += volume;
        object.mass += volume * material.density;
        model.tets.push_back(mesh.tets[t] + first);
        model.shear_moduli.push_back(static_cast<float>(shear_modulus(material)));
        const double kappa = body.has_springs() ? lacking_modulus(material) : moduli_of(material).kappa;
        model.tet_rests.push_back({checked_float(volume, body.name, "a tet's volume [m^3]"),
                                   body.has_springs() ? static_cast<float>(material.youngs_modulus) : 0.0f,
                                   static_cast<float>(bulk_modulus(material) - kappa),
                                   static_cast<float>(kappa)});
    }
    object.neo_hookean_tets.first = size(model.neo_hookean_tets);
    if (body.has_neo_hookean_tets()) append_neo_hookean_tets(model, body, order, first);
    object.neo_hookean_tets.count = size(model.neo_hookean_tets) - object.neo_hookean_tets.first;
    for (const glm::uvec3& f : mesh.faces) {
        model.faces.push_back({f.x + first, f.y + first, f.z + first, size(model.objects)});
    }
    append_box_tree(object.faces, model.face_trees);
    append_draw_surface(model.positions, model.faces, object.faces, kCreaseAngle, model.surface);
    model.objects.push_back(std::move(object));
    return std::move(order.new_index);
}

const Material& find_material(const Scene& scene, const std::string& name) {
    const auto found = std::find_if(scene.materials.begin(), scene.materials.end(),
                                    [&](const Material& m) { return m.name == name; });
    assert(found != scene.materials.end());
    return *found;
}

template <class Make>
auto with_file(const Scene& scene, const ObjectDescription& object, const Make& make) {
    try {
        return make();
    } catch (const InvalidInput& error) {
        const std::string field = fmt::format("{}.{}.shape", table_name(object), object.name);
        throw said_of_shape(scene.file, object.line, field, object.shape, error);
    }
}

void make_deformable(const Scene& scene, const ObjectDescription& object, ObjectMesher& mesher, Body& body) {
    body.mesh = with_file(scene, object, [&] { return mesher.make(object); });
    for (const PartDescription& part : object.parts)
        body.part_materials.push_back(find_material(scene, part.material));
    body.tet_materials = choose_tet_materials(object, body.mesh, scene.file.string());
    if (body.has_springs() && !body.material.springs) body.fitted = mesher.fit(object);
    body.scale = object.scale;
    body.skin = mesher.skin(object);
    body.cavities = make_cavities(scene.file, object, body.mesh);
}

// Its surface as it is, and what it weighs.
void make_rigid(const Scene& scene, const ObjectDescription& object, ObjectMesher& mesher, Body& body) {
    SurfaceMesh surface = with_file(
        scene, object, [&] { return mesher.surface(object.shape, "rigid body '" + object.name + "'"); });
    const Openness openness = measure_openness(surface);
    if (surface.faces.empty() || !openness.is_closed())
        throw InvalidInput(
            {scene.file.string(),
             object.line,
             fmt::format("rigid.{}.shape", object.name),
             {},
             fmt::format("its surface must be closed: it has {} faces, {} edges of one face and "
                         "{} of three or more",
                         surface.faces.size(), openness.boundary_edges, openness.non_manifold_edges)});
    const glm::dquat orientation = orientation_of(object, scene.up);
    for (glm::dvec3& p : surface.positions) p = orientation * (object.scale * p) + object.position;
    body.rigid_volume = signed_volume(surface);
    RigidNodes nodes = make_rigid_nodes(
        surface, with_description(solid_moments(surface, body.material.density), *object.rigid, orientation));
    body.mesh = std::move(nodes.mesh);
    body.rigid_masses = std::move(nodes.masses);
    if (surface.look.is_empty() && surface.look.corner_uvs.empty()) return;
    ShapeSkin skin{surface.faces, {}, 0.0, surface.look};
    for (std::uint32_t n = 0; n < surface.positions.size(); ++n)
        skin.vertices.push_back({glm::uvec4(n), {1.0, 0.0, 0.0, 0.0}});
    body.skin = std::make_shared<const ShapeSkin>(std::move(skin));
}

// Null: the handle has none.
std::shared_ptr<const BodySkeleton> skeleton_of(const Scene& scene, const ObjectDescription& object,
                                                std::size_t handle) {
    const HandleDescription& description = object.handles[handle];
    if (!description.skeleton) return nullptr;
    try {
        return std::make_shared<const BodySkeleton>(*description.skeleton, object, scene.up);
    } catch (const InvalidInput& error) {
        throw said_of(scene.file, description.line,
                      fmt::format("object.{}.handle[{}].skeleton", object.name, handle), error);
    }
}

Body make_body(const Scene& scene, const ObjectDescription& object, ObjectMesher& mesher) {
    Body body;
    body.name = object.name;
    body.material = find_material(scene, object.material);
    if (object.rigid) {
        make_rigid(scene, object, mesher, body);
    } else {
        make_deformable(scene, object, mesher, body);
    }
    body.velocity = object.velocity;
    body.spin = glm::radians(object.spin);
    body.pins = object.pins;
    body.handles = object.handles;
    std::vector<std::vector<std::uint32_t>> held;
    for (std::size_t h = 0; h < object.handles.size(); ++h) {
        body.skeletons.push_back(skeleton_of(scene, object, h));
        held.push_back(nodes_of(object.handles[h], body.skeletons[h].get(), body.mesh.positions));
    }
    body.loads = object.loads;
    if (object.color) body.color = glm::vec3(*object.color);
    check_regions(scene.file, object, body.mesh, held);
    return body;
}

// What remains is for packing the model.
constexpr double kShareOfMeshing = 0.9;

// What is done before each object. Copies of the object before take no time of their own.
std::vector<double> shares_of_meshing(const Scene& scene) {
    std::vector<double> shares;
    double done = 0.0;
    for (std::size_t o = 0; o < scene.objects.size(); ++o) {
        const ObjectDescription &object = scene.objects[o], &before = scene.objects[o > 0 ? o - 1 : 0];
        const bool is_copy = o > 0 && object.shape == before.shape && object.mesher == before.mesher;
        shares.push_back(done);
        if (!is_copy) done += 1.0;
    }
    for (double& share : shares) share *= kShareOfMeshing / done;
    return shares;
}

}  // namespace

Model pack_bodies(const std::vector<Body>& bodies, const std::vector<ColliderDescription>& colliders,
                  const glm::dvec3& gravity, const std::vector<ColliderSurface>& surfaces) {
    Model model;
    const bool has_skins =
        std::any_of(bodies.begin(), bodies.end(), [](const Body& b) { return b.skin != nullptr; });
    for (std::size_t b = 0; b < bodies.size(); ++b) {
        const std::vector<std::uint32_t> new_index = append_body(model, bodies[b]);
        if (bodies[b].skin != nullptr) {
            append_skin(*bodies[b].skin, bodies[b].scale, new_index, model);
        } else if (has_skins) {
            append_hull(model, b, model.skin);
        }
    }
    for (const ColliderSurface& surface : surfaces) {
        append_surface(surface, model);
        if (has_skins) append_hull(model, model.objects.size() - 1, model.skin);
    }
    finish_skin(model, model.skin);
    std::uint32_t animated = 0;
    for (HandleNode& held : model.handle_nodes)
        if (model.handles[held.handle].animation) held.animated = animated++;
    model.colliders = pack_colliders(colliders);
    model.gravity = glm::vec3(gravity);
    model.half_springs = pack_half_springs(model.node_count(), model.springs);
    model.incidence = make_incidence(model.node_count(), model.springs);
    model.neo_hookean_corners = make_neo_hookean_corners(model);
    model.node_objects = objects_of_nodes(model);
    model.node_faces = make_node_faces(model.node_count(), model.faces);
    model.surface_parts = make_surface_parts(model.faces, model.node_faces);
    model.volume_term =
        make_volume_term(model.tets, model.tet_rests, make_node_tets(model.node_count(), model.tets));
    return model;
}

Model build_model(const Scene& scene) {
    validate(scene);
    std::vector<Body> bodies;
    ObjectMesher mesher(scene.meshes, scene.up);
    const std::vector<double> shares = shares_of_meshing(scene);
    for (std::size_t o = 0; o < scene.objects.size(); ++o) {
        report_progress(shares[o], "object '" + scene.objects[o].name + "'");
        bodies.push_back(make_body(scene, scene.objects[o], mesher));
    }
    report_progress(kShareOfMeshing, "tables");
    Model model =
        pack_bodies(bodies, solid_colliders(scene), scene.gravity(), make_collider_surfaces(scene, mesher));
    model.meshes = std::make_shared<const SceneMeshes>(mesher.meshes());
    if (scene.collision.self_collision_with(scene.simulation.solver) && !scene.has_contact())
        model.rest_shapes = make_rest_shapes(model);
    return model;
}

}  // namespace gelatin
