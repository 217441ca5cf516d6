#include "model/assembly/collider_surface.h"

#include <fmt/core.h>

#include <algorithm>
#include <glm/geometric.hpp>
#include <utility>
#include <variant>

#include "gelatin/error.h"
#include "mesh/lattice/face_tree.h"
#include "mesh/lattice/solid_angles.h"
#include "model/assembly/draw_surface.h"
#include "model/assembly/make_animation.h"
#include "model/collision/box_tree.h"
#include "model/scene/field_path.h"
#include "model/spring_packing.h"
#include "model/transform.h"

namespace gelatin {
namespace {

constexpr std::uint32_t kMostSamples = 16;  // nodes of a body
constexpr std::uint32_t kFacesInLeaf = 64;  // for a few look-ups, a tree that is built fast

// Faces in the order of the tree over them, and nodes in the order of the faces. @return what nodes were
std::vector<std::uint32_t> arrange(SurfaceMesh& mesh) {
    arrange_faces(mesh.positions, mesh.faces);
    std::vector<std::uint32_t> places(mesh.positions.size(), kNoNode), earlier;
    std::vector<glm::dvec3> positions;
    for (glm::uvec3& face : mesh.faces) {
        for (int k = 0; k < 3; ++k) {
            std::uint32_t& place = places[face[k]];
            if (place == kNoNode) {
                place = static_cast<std::uint32_t>(positions.size());
                positions.push_back(mesh.positions[face[k]]);
                earlier.push_back(face[k]);
            }
            face[k] = place;
        }
    }
    mesh.positions = std::move(positions);
    return earlier;
}

// Not placed yet.
SurfaceMesh make_surface(const Scene& scene, const FieldPath& field, const Shape& shape,
                         const ColliderSurface& of, ObjectMesher& mesher) {
    const std::string place = describe(field / "shape", of.description.name);
    SurfaceMesh mesh;
    try {
        mesh = mesher.surface(shape, of.name);
    } catch (const InvalidInput& error) {
        throw said_of_shape(scene.file, of.description.line, place, shape, error);
    }
    if (mesh.faces.empty())
        throw InvalidInput({scene.file.string(), of.description.line, place, {}, "has no faces"});
    return mesh;
}

// Gives a surface the vertices that its animation has at the start. @pre it is as its shape has it
void animate(const Scene& scene, const FieldPath& field, const Shape& shape, ColliderSurface& surface) {
    const ColliderDescription& collider = surface.description;
    try {
        surface.animation = make_animation(*collider.animation, shape, surface.mesh);
    } catch (const InvalidInput& error) {
        throw said_of(scene.file, collider.line, describe(field / "animation", collider.name), error);
    }
    if (surface.animation->motion)
        surface.mesh.positions = surface.animation->arms(surface.animation->motion->at(0.0));
}

// Places an animation with its collider, whose nodes were arranged.
void place(const ColliderDescription& collider, const glm::dquat& rotation,
           const std::vector<std::uint32_t>& earlier, HandleAnimation& animation) {
    std::vector<std::uint32_t> sources;
    for (const std::uint32_t node : earlier) sources.push_back(animation.sources[node]);
    animation.sources = std::move(sources);
    animation.map = collider.scale * glm::mat3_cast(rotation);
    animation.offset = collider.position;
}

// Whether a body starts within it: sees the backs of its faces in more than half of all directions, as in a
// box, closed or without a lid.
bool surrounds_a_body(const SurfaceMesh& mesh, const Model& model) {
    const lattice::FaceTree tree(mesh, kFacesInLeaf);
    const lattice::SolidAngles winding_number(tree);
    const auto is_within = [&](const ModelObject& body) {
        const std::uint32_t stride = body.nodes.count / kMostSamples + 1;
        double backs = 0.0, samples = 0.0;
        for (std::uint32_t n = body.nodes.first; n < body.nodes.end(); n += stride, samples += 1.0)
            backs += winding_number(glm::dvec3(model.positions[n]));
        return backs > 0.5 * samples;
    };
    return std::any_of(model.bodies().begin(), model.bodies().end(), is_within);
}

void append_motion(const ColliderSurface& surface, const Range& nodes, Model& model) {
    const ColliderDescription& description = surface.description;
    Handle handle;
    handle.pivot = description.pivot.value_or(description.position);
    handle.interpolation = description.interpolation;
    handle.keyframes = description.keyframes;
    handle.stops = description.when_blocked == WhenBlocked::stops;
    if (surface.animation) {
        HandleAnimation animation = *surface.animation;
        animation.offset -= handle.pivot;
        handle.animation = std::make_shared<const HandleAnimation>(std::move(animation));
    }
    handle.object = model.objects.size();
    handle.count = nodes.count;
    const auto index = static_cast<std::uint32_t>(model.handles.size());
    for (std::uint32_t n = nodes.first; n < nodes.end(); ++n) {
        const glm::dvec3 arm = surface.mesh.positions[n - nodes.first] - handle.pivot;
        handle.radius = std::max(handle.radius, glm::length(arm));
        handle.middle += arm / static_cast<double>(nodes.count);
        model.handle_nodes.push_back({glm::vec4(glm::vec3(arm), 0.0f), n, index, kNoNode, 0});
    }
    model.handles.push_back(std::move(handle));
}

}  // namespace

std::string name_of_collider(const ColliderDescription& collider, std::size_t index) {
    return collider.name.empty() ? fmt::format("collider {}", index + 1) : collider.name;
}

// As it is, where nothing has to be turned: angles are not calculated back and forth.
ColliderDescription upright(ColliderDescription collider, Axis scene_up) {
    const glm::dquat orientation = orientation_of(collider, scene_up);
    if (orientation != rotation_from_degrees(collider.rotation))
        collider.rotation = degrees_from_rotation(orientation);
    collider.up.reset();
    return collider;
}

std::vector<ColliderDescription> solid_colliders(const Scene& scene) {
    std::vector<ColliderDescription> solid;
    for (const ColliderDescription& collider : scene.colliders)
        if (!scene.has_contact() || std::holds_alternative<PlaneCollider>(collider.shape))
            solid.push_back(upright(collider, scene.up));
    return solid;
}

std::vector<ColliderSurface> make_collider_surfaces(const Scene& scene) {
    ObjectMesher mesher(scene.meshes, scene.up);
    return make_collider_surfaces(scene, mesher);
}

std::vector<ColliderSurface> make_collider_surfaces(const Scene& scene, ObjectMesher& mesher) {
    std::vector<ColliderSurface> surfaces;
    if (!scene.has_contact()) return surfaces;
    for (std::size_t c = 0; c < scene.colliders.size(); ++c) {
        const ColliderDescription& collider = scene.colliders[c];
        const auto* shape = std::get_if<Shape>(&collider.shape);
        if (shape == nullptr) continue;
        ColliderSurface surface{name_of_collider(collider, c), {}, collider};
        const FieldPath field("collider", c);
        surface.mesh = make_surface(scene, field, *shape, surface, mesher);
        if (collider.animation) animate(scene, field, *shape, surface);
        const glm::dquat rotation = orientation_of(collider, scene.up);
        for (glm::dvec3& p : surface.mesh.positions) p = rotation * (collider.scale * p) + collider.position;
        const std::vector<std::uint32_t> earlier = arrange(surface.mesh);
        if (surface.animation) place(collider, rotation, earlier, *surface.animation);
        surfaces.push_back(std::move(surface));
    }
    return surfaces;
}

void append_surface(const ColliderSurface& surface, Model& model) {
    const auto size = [](const auto& array) { return static_cast<std::uint32_t>(array.size()); };
    const SurfaceMesh& mesh = surface.mesh;
    ModelObject object;
    object.name = surface.name;
    object.nodes = {size(model.positions), size(mesh.positions)};
    object.faces = {size(model.faces), size(mesh.faces)};
    object.tets.first = size(model.tets);
    object.springs.first = size(model.springs);
    object.neo_hookean_tets.first = size(model.neo_hookean_tets);
    object.handle_nodes.first = size(model.handle_nodes);
    for (const glm::dvec3& p : mesh.positions) {
        model.positions.emplace_back(glm::vec3(p), 0.0f);
        model.velocities.emplace_back(0.0f);
        model.masses.push_back(0.0f);
    }
    const bool moves = !surface.description.keyframes.empty() || surface.animation;
    if (moves) append_motion(surface, object.nodes, model);
    object.handle_nodes.count = size(model.handle_nodes) - object.handle_nodes.first;
    const std::uint32_t first = object.nodes.first;
    const bool is_reversed = surrounds_a_body(mesh, model);
    for (const glm::uvec3& f : mesh.faces) {
        const glm::uvec3 nodes = first + (is_reversed ? glm::uvec3(f.x, f.z, f.y) : f);
        model.faces.push_back({nodes.x, nodes.y, nodes.z, size(model.objects)});
    }
    append_box_tree(object.faces, model.face_trees);
    append_draw_surface(model.positions, model.faces, object.faces, kCreaseAngle, model.surface);
    model.surfaces.push_back({surface.description.friction, surface.description.restitution,
                              glm::vec3(surface.description.surface_velocity), moves,
                              surface.animation.has_value()});
    model.objects.push_back(std::move(object));
}

}  // namespace gelatin
