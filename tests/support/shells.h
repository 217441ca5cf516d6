#pragma once

#include <memory>
#include <vector>

#include "gelatin/scene.h"

namespace gelatin::test {

/// Tets between copies of a closed surface: each face is a prism from one layer to the next, and has three.
/// @param layers positions of the same vertices [m], the innermost first
/// @param faces counter-clockwise from outside
std::shared_ptr<const Mesh> make_shell(const std::vector<std::vector<glm::dvec3>>& layers,
                                       const std::vector<glm::uvec3>& faces);

/// Between two spheres about the origin [m]. @param frequency as of SphereShape @param layers of tets
std::shared_ptr<const Mesh> sphere_shell(double inner, double outer, int frequency, int layers);

/// Between two boxes about the origin, with cells of about the same size. @param size of the hollow [m]
std::shared_ptr<const Mesh> box_shell(const glm::dvec3& size, double wall, const glm::ivec3& segments,
                                      int layers);

/// Both in one, the second one displaced, with nothing in common.
std::shared_ptr<const Mesh> joined(const Mesh& first, const Mesh& second, const glm::dvec3& displacement);

}  // namespace gelatin::test
