#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <string>
#include <vector>

#include "model/model.h"
#include "model/skin.h"

namespace gelatin {

/// What is drawn of a model, as formats of animations need it: by object, with vertices that have one
/// texture coordinate each.
struct AnimatedSurface {
    struct Vertex {
        std::uint32_t point;  ///< among those of the object
        glm::vec2 uv{0.0f};   ///< (0, 0): the image's lower left
        bool operator==(const Vertex&) const = default;
    };
    /// The faces of an object with one material.
    struct Part {
        std::uint32_t material;              ///< in SurfaceLook::materials, or SurfaceLook::kNone
        std::vector<std::uint32_t> corners;  ///< vertices of the object, shape [faces][3]
    };
    struct Object {
        std::string name;
        Range points;  ///< in `points`
        bool has_uvs = false;
        std::vector<Vertex> vertices;
        std::vector<Part> parts;
    };
    std::vector<SkinPoint> points;
    std::vector<Object> objects;  ///< as Model::objects
    SurfaceLook look;
};

AnimatedSurface make_animated_surface(const Model& model);

/// The positions of an object's vertices. @param points x, y, z of each point of the object
std::vector<glm::vec3> vertex_positions(const AnimatedSurface::Object& object, std::span<const float> points);

/// Unit vectors: means of the normals of faces round each vertex, by their areas; vertices at one point share
/// theirs. (0, 1, 0) where there is none.
std::vector<glm::vec3> vertex_normals(const AnimatedSurface::Object& object, std::span<const float> points);

}  // namespace gelatin
