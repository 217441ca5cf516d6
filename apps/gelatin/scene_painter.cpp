#include "scene_painter.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "mesh/shapes.h"
#include "model/model.h"
#include "model/transform.h"

namespace gelatin {
namespace {

constexpr double kLevel = 0.9999;  // a normal's share of +y from which a plane counts as a floor

// A flat piece of a plane that is no floor, below the bodies and as wide as twice all of them.
SurfaceMesh make_plane_piece(const PlaneCollider& plane, const render::Bounds& bounds) {
    const glm::dvec3 n = plane.normal;
    const glm::dvec3 helper = std::abs(n.y) < 0.9 ? glm::dvec3(0.0, 1.0, 0.0) : glm::dvec3(1.0, 0.0, 0.0);
    const double reach = glm::length(glm::dvec3(bounds.size()));
    const glm::dvec3 u = reach * glm::normalize(glm::cross(helper, n)), v = glm::cross(n, u);
    const glm::dvec3 middle = glm::dvec3(bounds.center());
    const glm::dvec3 foot = middle + (plane.offset - glm::dot(n, middle)) * n;
    return {{foot - u - v, foot + u - v, foot + u + v, foot - u + v}, {{0, 1, 2}, {0, 2, 3}}};
}

SurfaceMesh make_collider_surface(const ColliderDescription& collider, const render::Bounds& bounds) {
    constexpr int kRoundness = 16;
    if (const auto* plane = std::get_if<PlaneCollider>(&collider.shape))
        return make_plane_piece(*plane, bounds);
    SurfaceMesh mesh;
    if (const auto* box = std::get_if<BoxCollider>(&collider.shape)) {
        mesh = make_box({box->size, glm::ivec3(1)});
    } else if (const auto* sphere = std::get_if<SphereCollider>(&collider.shape)) {
        mesh = make_sphere({sphere->radius, kRoundness});
    } else if (const auto* capsule = std::get_if<CapsuleCollider>(&collider.shape)) {
        mesh = make_capsule({capsule->radius, capsule->length, kRoundness});
    }
    const glm::dquat rotation = rotation_from_degrees(collider.rotation);
    for (glm::dvec3& p : mesh.positions) p = rotation * p + collider.position;
    return mesh;
}

bool is_floor(const ColliderDescription& collider) {
    const auto* plane = std::get_if<PlaneCollider>(&collider.shape);
    return plane != nullptr && plane->normal.y > kLevel;
}

std::optional<float> floor_height(const Scene& scene) {
    std::optional<float> height;
    for (const ColliderDescription& collider : scene.colliders) {
        if (!is_floor(collider)) continue;
        const auto offset = static_cast<float>(std::get<PlaneCollider>(collider.shape).offset);
        height = std::max(height.value_or(offset), offset);
    }
    return height;
}

render::Surroundings describe_surroundings(const Simulator& simulator) {
    render::Surroundings surroundings;
    surroundings.bounds = render::bounds_of(simulator.read_frame().positions);
    surroundings.floor_height = floor_height(simulator.scene());
    if (surroundings.floor_height) {  // what falls ends there
        glm::vec3 below = surroundings.bounds.center();
        below.y = *surroundings.floor_height;
        surroundings.bounds.add(below);
    }
    for (const ColliderDescription& collider : simulator.scene().colliders) {
        if (!is_floor(collider)) {
            surroundings.props.push_back(make_collider_surface(collider, surroundings.bounds));
        }
    }
    for (const ModelObject& object : simulator.model().objects) surroundings.colors.push_back(object.color);
    return surroundings;
}

// Bodies and what stands about them; sloping planes go on for ever and do not count.
render::Bounds bounds_of_all(const Scene& scene, const render::Surroundings& surroundings) {
    render::Bounds bounds = surroundings.bounds;
    for (const ColliderDescription& collider : scene.colliders) {
        if (std::holds_alternative<PlaneCollider>(collider.shape)) continue;
        const SurfaceMesh mesh = make_collider_surface(collider, bounds);
        for (const glm::dvec3& p : mesh.positions) bounds.add(glm::vec3(p));
    }
    return bounds;
}

render::Camera choose_camera(const Scene& scene, const render::Surroundings& surroundings,
                             const PictureSize& size) {
    if (const auto& camera = scene.camera) {
        return {glm::vec3(camera->eye), glm::vec3(camera->target), static_cast<float>(camera->field_of_view)};
    }
    const float aspect = static_cast<float>(size.width) / static_cast<float>(size.height);
    return render::frame_bounds(bounds_of_all(scene, surroundings), aspect);
}

render::RendererOptions renderer_options(const PictureSize& size) {
    render::RendererOptions options;
    options.width = size.width;
    options.height = size.height;
    return options;
}

}  // namespace

ScenePainter::ScenePainter(Simulator& simulator, const PictureSize& size)
    : simulator_(simulator), renderer_(renderer_options(size)) {
    const render::Surroundings surroundings = describe_surroundings(simulator);
    renderer_.set_surroundings(surroundings);
    camera_ = choose_camera(simulator.scene(), surroundings, size);
}

void ScenePainter::draw() {
    renderer_.draw(simulator_.render_view(), camera_);
}

}  // namespace gelatin
