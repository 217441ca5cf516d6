#include "sim/check_starts.h"

#include <fmt/core.h>

#include <algorithm>
#include <glm/geometric.hpp>

#include "core/counted.h"
#include "cpu/collision/colliders.h"
#include "cpu/collision/collision.h"
#include "cpu/collision/triangle_overlap.h"
#include "cpu/collision/walk_tree.h"
#include "gelatin/error.h"
#include "model/assembly/collider_surface.h"
#include "model/collision/pack_colliders.h"
#include "model/corners.h"

namespace gelatin {
namespace {

struct Depth {
    double depth = 0.0;  // [m]
    glm::dvec3 out{0.0};
};

Depth deepest(const Collider& collider, std::span<const glm::vec4> nodes) {
    Depth result;
    for (const glm::vec4& p : nodes) {
        if (p.w == 0.0f) continue;  // held nodes are not pushed out
        const cpu::SurfaceDistance<double> surface = cpu::surface_distance(collider, glm::dvec3(p));
        if (-surface.distance > result.depth) result = {-surface.distance, surface.normal};
    }
    return result;
}

double thickness_along(const glm::dvec3& direction, std::span<const glm::vec4> nodes) {
    double least = glm::dot(direction, glm::dvec3(nodes.front())), most = least;
    for (const glm::vec4& p : nodes) {
        const double along = glm::dot(direction, glm::dvec3(p));
        least = std::min(least, along);
        most = std::max(most, along);
    }
    return most - least;
}

// Faces without a corner in common.
std::size_t count_own_overlaps(const Model& model, std::uint32_t object, const cpu::Collision<double>& boxes,
                               std::span<const glm::dvec4> positions) {
    const auto triangle = [&](const Face& f) {
        return cpu::Triangle<double>{glm::dvec3(positions[f.a]), glm::dvec3(positions[f.b]),
                                     glm::dvec3(positions[f.c])};
    };
    const Range& faces = model.objects[object].faces;
    std::size_t count = 0;
    for (std::uint32_t f = faces.first; f < faces.end(); ++f) {
        const Face& face = model.faces[f];
        cpu::for_items_near<double>(model.face_trees, boxes.tree_boxes(), model.face_trees.roots[object],
                                    boxes.face_boxes()[f], [&](std::uint32_t g) {
                                        if (g > f && !share_corner(face, model.faces[g]) &&
                                            cpu::triangles_overlap(triangle(face), triangle(model.faces[g])))
                                            ++count;
                                    });
    }
    return count;
}

[[noreturn]] void refuse(const Scene& scene, const std::string& text) {
    throw InvalidInput({scene.file.string(), 0, "collision.response", "\"contact\"", text});
}

const char* name_of(const Collider& collider) {
    constexpr const char* kNames[] = {"plane", "box", "sphere", "capsule"};
    return kNames[collider.kind];
}

}  // namespace

std::vector<std::string> check_starts(const Model& model, const Scene& scene,
                                      std::span<const glm::vec4> positions) {
    std::vector<std::string> lines;
    for (std::size_t c = 0; c < scene.colliders.size(); ++c) {
        if (scene.has_contact() && !std::holds_alternative<PlaneCollider>(scene.colliders[c].shape))
            continue;  // a surface, not solid
        const Collider collider = pack_colliders({upright(scene.colliders[c], scene.up)}).front();
        std::string first;
        std::size_t others = 0;
        for (const ModelObject& object : model.bodies()) {
            const auto of_object = [&](std::span<const glm::vec4> nodes) {
                return nodes.subspan(object.nodes.first, object.shape_nodes().count);
            };
            const Depth found = deepest(collider, of_object(positions));
            if (found.depth == 0.0) continue;
            const double allowed = 0.5 * thickness_along(found.out, of_object(model.positions));
            if (found.depth <= allowed) continue;
            if (!first.empty()) {
                ++others;
                continue;
            }
            first = fmt::format(
                "object '{}': starts {:.3g} m deep inside collider {} (a {}), which may tear it as its nodes "
                "are pushed out; up to {:.3g} m, half of its thickness there, is safe",
                object.name, found.depth, c + 1, name_of(collider), allowed);
        }
        if (first.empty()) continue;
        lines.push_back(first + (others > 0 ? fmt::format(" (and {} more objects)", others) : ""));
    }
    return lines;
}

void require_apart(const std::shared_ptr<const Model>& model, const Scene& scene,
                   std::span<const glm::vec4> positions, const JoinedBodies& joined, std::string_view when) {
    const std::vector<glm::dvec4> exact(positions.begin(), positions.end());
    cpu::Collision<double> collision(model);
    collision.update_boxes(exact);
    collision.find_object_pairs();
    collision.find_face_collisions(exact);
    for (const cpu::ObjectPair& pair : collision.pairs()) {
        if (!model->is_body(pair.object) && !model->is_body(pair.other)) continue;
        if (are_joined(joined, pair.object, pair.other) || !collision.collide(pair)) continue;
        refuse(scene, fmt::format("needs objects that are apart {}; '{}' and '{}' overlap", when,
                                  model->objects[pair.object].name, model->objects[pair.other].name));
    }
}

std::vector<std::string> find_tangled(const std::shared_ptr<const Model>& model,
                                      std::span<const glm::vec4> positions, std::string_view when) {
    std::vector<std::string> lines;
    const std::vector<glm::dvec4> exact(positions.begin(), positions.end());
    cpu::Collision<double> collision(model);
    collision.update_boxes(exact);
    for (std::uint32_t o = 0; o < model->body_count(); ++o) {
        if (model->objects[o].is_rigid) continue;  // it does not press itself
        const std::size_t overlaps = count_own_overlaps(*model, o, collision, exact);
        if (overlaps == 0) continue;
        lines.push_back(
            fmt::format("object '{}' passes through itself {}, in {} of faces: it stays as it is there, and "
                        "may be held back",
                        model->objects[o].name, when, counted(overlaps, "pair")));
    }
    return lines;
}

}  // namespace gelatin
