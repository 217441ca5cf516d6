#pragma once

#include <glm/vec3.hpp>
#include <memory>
#include <vector>

#include "mesh/tet_mesh.h"
#include "model/assembly/build_model.h"
#include "model/model.h"

namespace gelatin {

/// A ball with a hole, 40 frequency^2 faces: a geodesic sphere, a smaller copy of it, and a layer of prisms
/// between them, each divided into three tets. Unlike a solid ball it needs no mesher, and nodes have the
/// same number of neighbours at any size.
TetMesh make_hollow_ball(double radius, int frequency);

/// Copies of a body at these positions [m]; no gravity, nothing else.
std::shared_ptr<const Model> make_copies(const Body& body, const std::vector<glm::dvec3>& places);

/// Bodies of the paper's springs with the same mesh: for collision, which does not depend on the material.
std::shared_ptr<const Model> make_copies(const TetMesh& mesh, const std::vector<glm::dvec3>& places);

/// The first `count` positions of a cubic lattice with that spacing, each displaced at random by up to
/// `jitter` along each axis [m]. The same positions in every run.
std::vector<glm::dvec3> jittered_lattice(std::size_t count, double spacing, double jitter);

}  // namespace gelatin
