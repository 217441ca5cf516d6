#pragma once

#include "model/model.h"
#include "ray.h"
#include "scene_source.h"

namespace gelatin::viewer {

/// A copy of a body as the scene describes it, to be thrown along a ray: it begins a part of the way in front
/// of its origin and arrives after some tenths of a second. Without what holds or pulls at the original in
/// its place: pins, handles, loads, parts by region. Its name is one that no object has.
/// @param model of that scene @param object index in both
/// @param distance to where the ray leads [m]
ObjectDescription make_projectile(const Scene& scene, const Model& model, std::size_t object, const Ray& ray,
                                  double distance);

}  // namespace gelatin::viewer
