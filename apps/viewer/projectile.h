#pragma once

#include "model/model.h"
#include "ray.h"
#include "scene_source.h"

namespace gelatin::viewer {

/// A copy of a body's description, to be thrown along a ray: it starts some distance in front of the ray's
/// origin and arrives after some tenths of a second. It has no pins, handles, loads or parts by region, which
/// belong to the original's position. Its name is unique.
/// @param model of that scene @param object index in both
/// @param distance to the target of the ray [m]
ObjectDescription make_projectile(const Scene& scene, const Model& model, std::size_t object, const Ray& ray,
                                  double distance);

}  // namespace gelatin::viewer
