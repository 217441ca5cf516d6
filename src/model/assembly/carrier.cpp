#include "model/assembly/carrier.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "model/collision/surface_parts.h"

namespace gelatin {

std::vector<glm::dvec3> positions_of_object(const ModelObject& object, std::span<const glm::vec4> positions) {
    const auto own = positions.subspan(object.nodes.first, object.nodes.count);
    return {own.begin(), own.end()};
}

Carrier::Carrier(const Model& model, std::uint32_t object, std::span<const glm::vec4> positions)
    : object_(model.objects[object]), is_rigid_(object_.is_rigid || !model.is_body(object)) {
    mesh_.positions = positions_of_object(object_, positions);
    for (std::uint32_t t = object_.tets.first; t < object_.tets.end(); ++t)
        mesh_.tets.push_back(model.tets[t] - object_.nodes.first);
    for (std::uint32_t f = object_.faces.first; f < object_.faces.end(); ++f) {
        const Face& face = model.faces[f];
        mesh_.faces.push_back(glm::uvec3(face.a, face.b, face.c) - object_.nodes.first);
    }
    edge_ = median_edge(model, object, positions);
    if (is_rigid_) find_frame();
}

std::vector<CarriedVertex> Carrier::carry(const std::vector<glm::dvec3>& points) const {
    std::vector<CarriedVertex> carried;
    if (is_rigid_) {
        for (const glm::dvec3& point : points) carried.push_back(carry_by_frame(point));
    } else {
        carried = carry_surface({points, {}}, mesh_).vertices;
    }
    for (CarriedVertex& vertex : carried) vertex.nodes += object_.nodes.first;
    return carried;
}

CarriedFrame Carrier::carry_point(const glm::dvec3& point) const {
    const CarriedVertex vertex = carry({point})[0];
    CarriedFrame carried;
    for (int k = 0; k < 4; ++k) {
        if (vertex.weights[k] == 0.0) continue;
        carried.nodes[carried.count] = vertex.nodes[k];
        carried.weights[carried.count++].x = vertex.weights[k];
    }
    return carried;
}

CarriedFrame Carrier::carry_frame(const Frame& frame) const {
    const CarriedVertex vertex = carry({frame.point})[0];
    CarriedFrame carried{.count = 4};
    for (int k = 0; k < 4; ++k) {
        const auto node = static_cast<std::size_t>(k);
        carried.nodes[node] = vertex.nodes[k];
        carried.weights[node].x = vertex.weights[k];
        for (int axis = 0; axis < 3; ++axis)
            carried.weights[node][1 + axis] = weights_of(frame.axes[axis])[k];
    }
    return carried;
}

double Carrier::size() const {
    glm::dvec3 mean(0.0);
    for (int k = 0; k < 4; ++k) mean += 0.25 * mesh_.positions[frame_[k]];
    double sum = 0.0;
    for (int k = 0; k < 4; ++k) sum += 0.25 * glm::distance(mean, mesh_.positions[frame_[k]]);
    return sum;
}

bool Carrier::can_carry() const {
    const glm::dmat3 edges = frame_edges();
    const double size = glm::length(edges[0]);
    return !is_rigid_ || std::abs(glm::determinant(edges)) > 1e-3 * size * size * size;
}

void Carrier::find_frame() {
    std::vector<std::uint32_t> nodes;
    for (const glm::uvec3& face : mesh_.faces) nodes.insert(nodes.end(), {face.x, face.y, face.z});
    const auto farthest = [&](const auto& measure) {
        return *std::max_element(nodes.begin(), nodes.end(), [&](std::uint32_t a, std::uint32_t b) {
            return measure(mesh_.positions[a]) < measure(mesh_.positions[b]);
        });
    };
    const auto at = [&](int k) { return mesh_.positions[frame_[k]]; };
    frame_.x = farthest([&](const glm::dvec3& p) { return glm::distance(p, mesh_.positions[nodes[0]]); });
    frame_.y = farthest([&](const glm::dvec3& p) { return glm::distance(p, at(0)); });
    frame_.z =
        farthest([&](const glm::dvec3& p) { return glm::length(glm::cross(at(1) - at(0), p - at(0))); });
    const glm::dvec3 normal = glm::cross(at(1) - at(0), at(2) - at(0));
    frame_.w = farthest([&](const glm::dvec3& p) { return std::abs(glm::dot(normal, p - at(0))); });
}

glm::dmat3 Carrier::frame_edges() const {
    const auto at = [&](int k) { return mesh_.positions[frame_[k]]; };
    return {at(1) - at(0), at(2) - at(0), at(3) - at(0)};
}

// Of the four nodes, with the sum 0.
glm::dvec4 Carrier::weights_of(const glm::dvec3& vector) const {
    const glm::dvec3 along = glm::inverse(frame_edges()) * vector;
    return {-along.x - along.y - along.z, along};
}

CarriedVertex Carrier::carry_by_frame(const glm::dvec3& point) const {
    return {frame_, glm::dvec4(1.0, 0.0, 0.0, 0.0) + weights_of(point - mesh_.positions[frame_.x])};
}

}  // namespace gelatin
