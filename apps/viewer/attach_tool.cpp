#include "attach_tool.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <utility>

#include "gelatin/error.h"
#include "sim/attachment_lines.h"
#include "sim/simulator_internals.h"

namespace gelatin::viewer {
namespace {

constexpr double kApart = 0.05;  // of the cube root of a body's volume: the sides of a joint are apart

// How far it is to the front of the nearest plane [m].
std::optional<float> distance_to_plane(const Ray& ray, const Scene& scene) {
    std::optional<float> nearest;
    for (const ColliderDescription& collider : scene.colliders) {
        const auto* plane = std::get_if<PlaneCollider>(&collider.shape);
        if (plane == nullptr) continue;
        const auto towards = static_cast<float>(-glm::dot(plane->normal, glm::dvec3(ray.direction)));
        const auto height =
            static_cast<float>(glm::dot(plane->normal, glm::dvec3(ray.origin)) - plane->offset);
        if (towards <= 0.0f || height <= 0.0f) continue;
        const float distance = height / towards;
        if (!nearest || distance < *nearest) nearest = distance;
    }
    return nearest;
}

// What the second click meets: a point, and what a scene calls that; "" for what never moves.
struct Target {
    glm::dvec3 point;
    std::string name;
};

std::string target_name(const Simulator& simulator, std::uint32_t object) {
    const Model& model = model_of(simulator);
    const std::string& name = model.objects[object].name;
    if (model.is_body(object)) return name;
    if (!model.surfaces[object - model.body_count()].moves) return {};
    const auto& colliders = simulator.scene().colliders;
    const auto count = std::count_if(colliders.begin(), colliders.end(),
                                     [&](const ColliderDescription& c) { return c.name == name; });
    if (count == 1) return name;
    throw InvalidInput(
        fmt::format("'{}' moves, and has no name of its own in the scene: only with one can "
                    "a body be attached to it",
                    name));
}

std::optional<Target> find_target(const Ray& ray, const Simulator& simulator,
                                  const std::optional<Pick>& found) {
    const std::optional<float> plane = distance_to_plane(ray, simulator.scene());
    if (plane && (!found || *plane < found->distance)) return Target{glm::dvec3(ray.at(*plane)), ""};
    if (!found) return {};
    return Target{glm::dvec3(found->point), target_name(simulator, found->object)};
}

std::string free_attachment_name(const Scene& scene, const char* kind) {
    const auto& all = scene.attachments;
    for (std::size_t i = 1;; ++i) {
        std::string name = fmt::format("{} {}", kind, i);
        if (std::none_of(all.begin(), all.end(), [&](const auto& other) { return other.name == name; }))
            return name;
    }
}

}  // namespace

const char* AttachTool::hint() const {
    return first_ ? "click what to attach it to, with Ctrl by a rope (Esc: nothing)"
                  : "click the point of a body that is to be attached (Esc: none)";
}

std::optional<std::string> AttachTool::follow(Simulator& simulator) {
    if (!waits_ || (!click_ && !first_)) return {};
    const Model& model = model_of(simulator);
    const std::vector<float> positions = drawn_positions(model, simulator.read_frame().positions);
    if (first_) first_point_ = place_of(*first_, positions);
    if (!click_) return {};
    const Click click = *std::exchange(click_, {});
    const std::span<const Face> faces = drawn_faces(model);
    const std::optional<Pick> found = pick(click.ray, positions, faces);
    if (!first_) {
        if (!found || !model.is_body(found->object)) return {};
        first_ = face_point(*found, faces[found->face], positions);
        first_point_ = found->point;
        return {};
    }
    const FacePoint first = *first_;
    const glm::dvec3 from(*first_point_);
    cancel();
    AttachmentDescription made;
    made.object = model.objects[first.face.object].name;
    made.where = AttachedPoint{from};
    const char* kind = "joint";
    if (const std::optional<Target> target = find_target(click.ray, simulator, found)) {
        made.to = target->name;
        const double distance = glm::distance(from, target->point);
        if (distance < 0.5 * static_cast<double>(shortest_edge(first, positions))) {
            made.where = AttachedPoint{0.5 * (from + target->point)};
        } else {
            kind = click.is_rope ? "rope" : "rod";
            made.where = AttachedDistance{from, target->point};
            if (click.is_rope) made.limits = glm::dvec2(0.0, distance);
        }
    }
    made.name = free_attachment_name(simulator.scene(), kind);
    simulator.attach(made);
    return fmt::format("{}: '{}' to {}", made.name, made.object,
                       made.to.empty() ? "space" : fmt::format("'{}'", made.to));
}

AttachmentDescription moved_attachment(const AttachmentDescription& description, const Attachment& made,
                                       const Model& model, std::span<const glm::vec4> positions) {
    AttachmentDescription moved = description;
    const AttachedPoints points = attached_points(made, model, positions).front();
    const double distance = glm::distance(points.own, points.other);
    if (auto* point = std::get_if<AttachedPoint>(&moved.where)) {
        point->at = points.own;
        const double most = kApart * std::cbrt(static_cast<double>(model.objects[made.object].rest_volume));
        if (!made.is_in_space && distance > most) moved.where = AttachedDistance{points.own, points.other};
    } else if (std::holds_alternative<AttachedDistance>(moved.where)) {
        moved.where = AttachedDistance{points.own, points.other};
        if (moved.limits) moved.limits->y = std::max(moved.limits->y, distance);
    }
    return moved;
}

}  // namespace gelatin::viewer
