#include "render/static_mesh.h"

#include <algorithm>
#include <glm/geometric.hpp>

namespace gelatin::render {
namespace {

constexpr double kCosineOfCrease = 0.766;  // 40 degrees

std::vector<std::vector<std::uint32_t>> faces_by_vertex(const SurfaceMesh& surface) {
    std::vector<std::vector<std::uint32_t>> faces(surface.positions.size());
    for (std::uint32_t f = 0; f < surface.faces.size(); ++f) {
        for (int corner = 0; corner < 3; ++corner) faces[surface.faces[f][corner]].push_back(f);
    }
    return faces;
}

glm::dvec3 unit_or_zero(const glm::dvec3& v) {
    const double length = glm::length(v);
    return length > 0.0 ? v / length : glm::dvec3(0.0);
}

// A vertex of the surface, for one of its smooth sides.
struct Corner {
    std::uint32_t vertex;
    glm::dvec3 normal;  // not unit
};

// The corners of all faces, each once. Appends the faces over them, numbered from `first`, to `triangles`.
std::vector<Corner> split_at_creases(const SurfaceMesh& surface, std::vector<std::uint32_t>& triangles,
                                     std::uint32_t first) {
    std::vector<glm::dvec3> areas;  // twice the face's area along its normal
    for (const glm::uvec3& f : surface.faces) {
        const glm::dvec3& a = surface.positions[f.x];
        areas.push_back(glm::cross(surface.positions[f.y] - a, surface.positions[f.z] - a));
    }
    const auto around = faces_by_vertex(surface);
    std::vector<Corner> corners;
    std::vector<std::vector<std::uint32_t>> corners_of(surface.positions.size());
    for (std::size_t f = 0; f < surface.faces.size(); ++f) {
        for (int k = 0; k < 3; ++k) {
            const std::uint32_t vertex = surface.faces[f][k];
            glm::dvec3 normal(0.0);
            for (const std::uint32_t neighbour : around[vertex]) {
                const double cosine = glm::dot(unit_or_zero(areas[f]), unit_or_zero(areas[neighbour]));
                if (cosine > kCosineOfCrease) normal += areas[neighbour];
            }
            // Faces of one smooth side add up the same neighbours in the same order, so they get the same
            // bits.
            auto& known = corners_of[vertex];
            const auto same = std::find_if(known.begin(), known.end(),
                                           [&](std::uint32_t c) { return corners[c].normal == normal; });
            const auto index = same == known.end() ? static_cast<std::uint32_t>(corners.size()) : *same;
            if (same == known.end()) {
                known.push_back(index);
                corners.push_back({vertex, normal});
            }
            triangles.push_back(first + index);
        }
    }
    return corners;
}

}  // namespace

StaticMesh::StaticMesh(const std::vector<SurfaceMesh>& surfaces)
    : object_count_(static_cast<std::uint32_t>(surfaces.size())) {
    std::vector<glm::vec4> positions;
    std::vector<glm::vec4> normals;
    std::vector<glm::uvec4> vertices;
    std::vector<std::uint32_t> triangles;
    for (std::uint32_t object = 0; object < surfaces.size(); ++object) {
        const SurfaceMesh& surface = surfaces[object];
        const std::size_t first = vertices.size();
        for (const Corner& corner : split_at_creases(surface, triangles, static_cast<std::uint32_t>(first))) {
            vertices.emplace_back(positions.size(), object, 0u, 0u);
            positions.emplace_back(glm::vec3(surface.positions[corner.vertex]), 0.0f);
            if (positions.size() == 1) bounds_ = {glm::vec3(positions[0]), glm::vec3(positions[0])};
            bounds_.add(glm::vec3(positions.back()));
            normals.emplace_back(glm::vec3(unit_or_zero(corner.normal)), 0.0f);
        }
    }
    positions_ = gl::Buffer<glm::vec4>(std::span<const glm::vec4>(positions));
    vertices_ = gl::Buffer<glm::uvec4>(std::span<const glm::uvec4>(vertices));
    normals_ = gl::Buffer<glm::vec4>(std::span<const glm::vec4>(normals));
    triangles_ = gl::Buffer<std::uint32_t>(std::span<const std::uint32_t>(triangles));
}

RenderView StaticMesh::view() const {
    return {.node_positions = positions_.id(),
            .surface_vertices = vertices_.id(),
            .vertex_normals = normals_.id(),
            .triangles = triangles_.id(),
            .node_count = static_cast<std::uint32_t>(positions_.size()),
            .vertex_count = static_cast<std::uint32_t>(vertices_.size()),
            .face_count = static_cast<std::uint32_t>(triangles_.size() / 3),
            .object_count = object_count_,
            .box_min = {bounds_.min.x, bounds_.min.y, bounds_.min.z},
            .box_max = {bounds_.max.x, bounds_.max.y, bounds_.max.z}};
}

}  // namespace gelatin::render
