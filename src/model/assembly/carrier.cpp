#include "model/assembly/carrier.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <limits>

#include "mesh/tet_tree.h"
#include "model/collision/surface_parts.h"

namespace gelatin {
namespace {

bool deforms(const Model& model, std::uint32_t object) {
    return !model.is_body(object) && model.surfaces[object - model.body_count()].deforms;
}

TetMesh mesh_of(const Model& model, const ModelObject& object, std::span<const glm::vec4> positions) {
    TetMesh mesh;
    mesh.positions = positions_of_object(object, positions);
    for (std::uint32_t t = object.tets.first; t < object.tets.end(); ++t)
        mesh.tets.push_back(model.tets[t] - object.nodes.first);
    for (std::uint32_t f = object.faces.first; f < object.faces.end(); ++f) {
        const Face& face = model.faces[f];
        mesh.faces.push_back(glm::uvec3(face.a, face.b, face.c) - object.nodes.first);
    }
    return mesh;
}

}  // namespace

std::vector<glm::dvec3> positions_of_object(const ModelObject& object, std::span<const glm::vec4> positions) {
    const auto own = positions.subspan(object.nodes.first, object.nodes.count);
    return {own.begin(), own.end()};
}

Carrier::Carrier(const Model& model, std::uint32_t object, std::span<const glm::vec4> positions)
    : object_(model.objects[object]),
      is_rigid_(object_.is_rigid || !(model.is_body(object) || deforms(model, object))),
      is_surface_(!model.is_body(object)),
      mesh_(mesh_of(model, object_, positions)),
      edge_(median_edge(model, object, positions)),
      hull_({mesh_.positions, mesh_.faces}),
      winding_number_(hull_) {
    if (is_rigid_ || is_surface_) find_frame();
}

bool Carrier::is_near(const glm::dvec3& point, double most) const {
    return hull_.find_nearest(point, most) || std::abs(winding_number_(point)) > 0.5;
}

std::vector<CarriedVertex> Carrier::carry(const std::vector<glm::dvec3>& points) const {
    std::vector<CarriedVertex> carried;
    if (is_rigid_) {
        for (const glm::dvec3& point : points) carried.push_back(carry_by_frame(point));
    } else if (is_surface_) {
        for (const glm::dvec3& point : points) carried.push_back(carry_by_face(point));
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
    if (!is_rigid_ && !is_surface_) return true;
    constexpr double kThinnest = 1e-3;  // as a part of the length
    const glm::dmat3 edges = frame_edges();
    const double length = glm::length(edges[0]), width = glm::length(glm::cross(edges[0], edges[1])) / length,
                 height = std::abs(glm::determinant(edges)) / (length * width);
    return width > kThinnest * length && height > kThinnest * length;
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

// A node that is not in the plane of the face says how the surface turns there. It counts with the distance
// of the point from this plane over its own, h, and says the less the farther it is: so the one is best that
// has the least squared distance over h.
CarriedVertex Carrier::carry_by_face(const glm::dvec3& point) const {
    const lattice::NearestPoint nearest = *hull_.find_nearest(point, std::numeric_limits<double>::infinity());
    const glm::uvec3& face = mesh_.faces[hull_.sources()[nearest.face]];
    const glm::dvec3 a = mesh_.positions[face.x];
    const glm::dvec3 normal =
        glm::normalize(glm::cross(mesh_.positions[face.y] - a, mesh_.positions[face.z] - a));
    std::uint32_t best = 0;
    double least = std::numeric_limits<double>::infinity();
    for (std::uint32_t n = 0; n < mesh_.positions.size(); ++n) {
        const glm::dvec3 from = mesh_.positions[n] - nearest.point;
        const double cost = glm::dot(from, from) / std::abs(glm::dot(normal, from));
        if (!(cost < least)) continue;
        least = cost;
        best = n;
    }
    const glm::uvec4 nodes(face, best);
    return {nodes, barycentric(mesh_, nodes, point)};
}

}  // namespace gelatin
