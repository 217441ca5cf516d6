#pragma once

#include <glm/vec3.hpp>
#include <memory>
#include <vector>

#include "mesh/tet_mesh.h"
#include "model/model.h"

namespace gelatin {

/// A ball with a hole, 40 frequency^2 faces: a geodesic sphere, the same again smaller, and a layer of prisms
/// between them, each cut into three tets. Unlike a solid ball it needs no mesher and has as many neighbours
/// a node at any size.
TetMesh make_hollow_ball(double radius, int frequency);

/// Bodies of one mesh, at these places [m]; no gravity, nothing else.
std::shared_ptr<const Model> make_copies(const TetMesh& mesh, const std::vector<glm::dvec3>& places);

/// Places in a cubic lattice of that spacing, the first so many, each moved at random by up to `jitter` along
/// each axis [m]. The same places in every run.
std::vector<glm::dvec3> jittered_lattice(std::size_t count, double spacing, double jitter);

}  // namespace gelatin
