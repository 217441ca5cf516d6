#include "picking.h"

#include <algorithm>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>

namespace gelatin::viewer {
namespace {

constexpr float kReach = 0.5f;  // of half the diagonal of the body's box

glm::vec3 position_of(std::span<const float> positions, std::uint32_t node) {
    const float* p = positions.data() + 3 * std::size_t{node};
    return {p[0], p[1], p[2]};
}

// The distance along the ray to the front of a triangle (Moeller and Trumbore 1997).
std::optional<float> distance_to(const Ray& ray, const glm::vec3& a, const glm::vec3& b, const glm::vec3& c) {
    const glm::vec3 ab = b - a, ac = c - a, across = glm::cross(ray.direction, ac);
    const float determinant = glm::dot(ab, across);
    if (!(determinant > 0.0f)) return {};
    const glm::vec3 from_a = ray.origin - a, normal = glm::cross(from_a, ab);
    const float u = glm::dot(from_a, across) / determinant, v = glm::dot(ray.direction, normal) / determinant;
    const float distance = glm::dot(ac, normal) / determinant;
    const bool is_inside = u >= 0.0f && v >= 0.0f && u + v <= 1.0f && distance > 0.0f;
    return is_inside ? std::optional(distance) : std::nullopt;
}

float reach_of_hand(const Range& nodes, std::span<const float> positions) {
    glm::vec3 low = position_of(positions, nodes.first), high = low;
    for (std::uint32_t n = nodes.first; n < nodes.end(); ++n) {
        low = glm::min(low, position_of(positions, n));
        high = glm::max(high, position_of(positions, n));
    }
    return 0.5f * kReach * glm::distance(low, high);
}

// Those that carry the corners of a face that is drawn; each once or more.
std::vector<std::uint32_t> carrying_nodes(const Model& model, std::uint32_t face) {
    const Face& f = drawn_faces(model)[face];
    if (model.skin.is_empty()) return {f.a, f.b, f.c};
    std::vector<std::uint32_t> nodes;
    for (const std::uint32_t corner : {f.a, f.b, f.c}) {
        const SkinPoint& point = model.skin.points[corner];
        nodes.insert(nodes.end(), {point.a, point.b, point.c, point.d});
    }
    return nodes;
}

}  // namespace

std::span<const Face> drawn_faces(const Model& model) {
    return model.skin.is_empty() ? model.faces : model.skin.faces;
}

std::vector<float> drawn_positions(const Model& model, std::vector<float> positions) {
    if (model.skin.is_empty()) return positions;
    return carry_skin(model.skin.points, std::span<const float>(positions));
}

std::optional<Pick> pick(const Ray& ray, std::span<const float> positions, std::span<const Face> faces) {
    std::optional<Pick> nearest;
    for (std::uint32_t f = 0; f < faces.size(); ++f) {
        const Face& face = faces[f];
        const auto distance = distance_to(ray, position_of(positions, face.a), position_of(positions, face.b),
                                          position_of(positions, face.c));
        if (!distance || (nearest && nearest->distance <= *distance)) continue;
        nearest = Pick{f, face.object, ray.at(*distance), *distance};
    }
    return nearest;
}

FacePoint face_point(const Pick& pick, const Face& face, std::span<const float> positions) {
    const glm::vec3 a = position_of(positions, face.a), b = position_of(positions, face.b),
                    c = position_of(positions, face.c), normal = glm::cross(b - a, c - a);
    const auto share = [&](const glm::vec3& from, const glm::vec3& to) {
        return glm::dot(normal, glm::cross(to - from, pick.point - from)) / glm::dot(normal, normal);
    };
    return {face, {share(b, c), share(c, a), share(a, b)}};
}

glm::vec3 place_of(const FacePoint& point, std::span<const float> positions) {
    return point.weights.x * position_of(positions, point.face.a) +
           point.weights.y * position_of(positions, point.face.b) +
           point.weights.z * position_of(positions, point.face.c);
}

float shortest_edge(const FacePoint& point, std::span<const float> positions) {
    const glm::vec3 a = position_of(positions, point.face.a), b = position_of(positions, point.face.b),
                    c = position_of(positions, point.face.c);
    return std::min({glm::distance(a, b), glm::distance(b, c), glm::distance(c, a)});
}

Pull take_hold(const Model& model, std::span<const float> positions, const Pick& pick) {
    const ModelObject& object = model.objects[pick.object];
    const std::vector<std::uint32_t> carrying = carrying_nodes(model, pick.face);
    const float reach = reach_of_hand(object.shape_nodes(), positions);
    Pull pull;
    double sum = 0.0;
    for (std::uint32_t n = object.nodes.first; n < object.nodes.end(); ++n) {
        const glm::vec3 arm = position_of(positions, n) - pick.point;
        const float part = glm::dot(arm, arm) / (reach * reach);
        const float firmness = part < 1.0f ? (1.0f - part) * (1.0f - part) : 0.0f;
        const bool carries = std::find(carrying.begin(), carrying.end(), n) != carrying.end();
        const float weight = model.masses[n] * std::max(firmness, carries ? 0.1f : 0.0f);
        if (weight == 0.0f) continue;
        pull.nodes.push_back({n, arm, weight});
        sum += static_cast<double>(weight);
    }
    const double stiffness = object.mass * kHandRate * kHandRate;
    for (Pull::Node& held : pull.nodes)
        held.stiffness = static_cast<float>(static_cast<double>(held.stiffness) / sum * stiffness);
    pull.target = glm::dvec3(pick.point);
    pull.damping_time = 2.0 / kHandRate;
    return pull;
}

SphereRegion region_of(const Pull& pull, const Model& model) {
    const auto at_rest = [&](const Pull::Node& held) { return glm::dvec3(model.positions[held.node]); };
    SphereRegion region{glm::dvec3(0.0), 0.0};
    double sum = 0.0;
    for (const Pull::Node& held : pull.nodes) {
        region.center += static_cast<double>(held.stiffness) * at_rest(held);
        sum += static_cast<double>(held.stiffness);
    }
    region.center /= sum;
    double nearest = std::numeric_limits<double>::infinity(), farthest = 0.0;
    for (const Pull::Node& held : pull.nodes) {
        nearest = std::min(nearest, glm::distance(region.center, at_rest(held)));
        farthest = std::max(farthest, glm::distance(region.center, at_rest(held)));
    }
    region.radius = std::max(0.5 * farthest, 1.001 * nearest);
    return region;
}

}  // namespace gelatin::viewer
