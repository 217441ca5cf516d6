#include "sim/animation/animated_surface.h"

#include <algorithm>
#include <array>
#include <glm/geometric.hpp>
#include <map>
#include <tuple>
#include <unordered_map>

#include "model/assembly/pack_skin.h"

namespace gelatin {
namespace {

glm::vec3 at(std::span<const float> points, std::uint32_t point) {
    const std::size_t first = 3 * std::size_t{point};
    return {points[first], points[first + 1], points[first + 2]};
}

/// Collects the faces of an object.
class Collector {
public:
    Collector(AnimatedSurface::Object& object, const SurfaceLook& look) : object_(object), look_(look) {
        object_.has_uvs = false;
    }

    /// @param f of the face, in the look
    void add(const Face& face, std::size_t f) {
        const bool has_look = !look_.is_empty();
        const std::uint32_t material = has_look ? look_.face_materials[f] : SurfaceLook::kNone;
        const std::array<std::uint32_t, 3> points{face.a, face.b, face.c};
        std::vector<std::uint32_t>& corners = part_of(material).corners;
        for (std::size_t k = 0; k < 3; ++k) {
            const glm::vec2 uv = has_look ? look_.corner_uvs[f][k] : glm::vec2(0.0f);
            if (uv != glm::vec2(0.0f)) object_.has_uvs = true;
            corners.push_back(vertex({points[k] - object_.points.first, uv}));
        }
    }

private:
    AnimatedSurface::Part& part_of(std::uint32_t material) {
        const auto found = std::find_if(object_.parts.begin(), object_.parts.end(),
                                        [&](const auto& part) { return part.material == material; });
        if (found != object_.parts.end()) return *found;
        object_.parts.push_back({material, {}});
        return object_.parts.back();
    }

    std::uint32_t vertex(const AnimatedSurface::Vertex& vertex) {
        const auto [known, is_new] = numbers_.try_emplace(
            {vertex.point, vertex.uv.x, vertex.uv.y}, static_cast<std::uint32_t>(object_.vertices.size()));
        if (is_new) object_.vertices.push_back(vertex);
        return known->second;
    }

    AnimatedSurface::Object& object_;
    const SurfaceLook& look_;
    std::map<std::tuple<std::uint32_t, float, float>, std::uint32_t> numbers_;
};

}  // namespace

AnimatedSurface make_animated_surface(const Model& model) {
    const Skin hulls = model.skin.is_empty() ? make_hulls(model) : Skin();
    const Skin& drawn = model.skin.is_empty() ? hulls : model.skin;
    AnimatedSurface surface{drawn.points, {}, drawn.look};
    for (std::size_t o = 0; o < model.objects.size(); ++o) {
        AnimatedSurface::Object& object = surface.objects.emplace_back();
        object.name = model.objects[o].name;
        object.points = drawn.objects[o].points;
        Collector collector(object, drawn.look);
        const Range& faces = drawn.objects[o].faces;
        for (std::uint32_t f = faces.first; f < faces.end(); ++f) collector.add(drawn.faces[f], f);
    }
    return surface;
}

std::vector<glm::vec3> vertex_positions(const AnimatedSurface::Object& object,
                                        std::span<const float> points) {
    std::vector<glm::vec3> positions;
    positions.reserve(object.vertices.size());
    for (const AnimatedSurface::Vertex& vertex : object.vertices)
        positions.push_back(at(points, vertex.point));
    return positions;
}

std::vector<glm::vec3> vertex_normals(const AnimatedSurface::Object& object, std::span<const float> points) {
    std::unordered_map<std::uint32_t, glm::vec3> sums;  // by point
    for (const AnimatedSurface::Part& part : object.parts) {
        for (std::size_t k = 0; k < part.corners.size(); k += 3) {
            std::array<std::uint32_t, 3> corners;
            for (std::size_t c = 0; c < 3; ++c) corners[c] = object.vertices[part.corners[k + c]].point;
            const glm::vec3 a = at(points, corners[0]);
            const glm::vec3 area = glm::cross(at(points, corners[1]) - a, at(points, corners[2]) - a);
            for (const std::uint32_t point : corners) sums[point] += area;
        }
    }
    std::vector<glm::vec3> normals;
    normals.reserve(object.vertices.size());
    for (const AnimatedSurface::Vertex& vertex : object.vertices) {
        const glm::vec3& sum = sums[vertex.point];
        const float length = glm::length(sum);
        normals.push_back(length > 0.0f ? sum / length : glm::vec3(0, 1, 0));
    }
    return normals;
}

}  // namespace gelatin
