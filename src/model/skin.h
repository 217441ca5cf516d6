#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <span>
#include <vector>

#include "mesh/surface_look.h"
#include "model/draw_surface.h"
#include "model/layouts.h"
#include "model/range.h"

namespace gelatin {

/// What is drawn of one object: its own surface, or the boundary of its tets.
struct SkinObject {
    Range points, faces;
    double distance = 0.0;  ///< at most, between the two surfaces [m]; 0: it is the boundary
};

/// What is drawn and exported of all objects, where an object's surface is not the boundary of its tets, its
/// hull: points that move with the nodes, and faces between them. Objects without a surface of their own have
/// a point at each node of their hull, so that all are drawn and exported alike. Collisions know nothing of
/// it.
struct Skin {
    std::vector<SkinPoint> points;    ///< in the order of their file
    std::vector<Face> faces;          ///< between points, in the order of their file
    DrawSurface surface;              ///< over `faces`; a vertex names a point instead of a node
    std::vector<SkinObject> objects;  ///< as Model::objects; none: there is no skin
    SurfaceLook look;                 ///< of all faces; empty: each as its object

    bool is_empty() const { return objects.empty(); }
};

/// What the nodes make of one of their properties at a point: their positions its position [m], their
/// velocities its velocity [m/s]. Differences keep the precision of small bodies far from the origin.
/// GLSL twin: shaders/sim/view/carry_skin.comp.
/// @param of returns a node's vector
template <class Vector, class OfNode>
Vector carried(const SkinPoint& point, const OfNode& of) {
    using Real = typename Vector::value_type;
    const Vector a = of(point.a);
    return a + static_cast<Real>(point.weights.y) * (of(point.b) - a) +
           static_cast<Real>(point.weights.z) * (of(point.c) - a) +
           static_cast<Real>(point.weights.w) * (of(point.d) - a);
}

/// The points' positions: xyz [m], 1. On several threads. GPU twin: gpu::CarrySkin.
/// @param positions of all nodes, xyz [m]
std::vector<glm::vec4> carry_skin(std::span<const SkinPoint> points, std::span<const glm::vec4> positions);

/// The same of any property of nodes. @param of_nodes x, y, z of each node @return x, y, z of each point
std::vector<float> carry_skin(std::span<const SkinPoint> points, std::span<const float> of_nodes);

}  // namespace gelatin
