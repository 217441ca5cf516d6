#pragma once

#include <cstdint>
#include <functional>
#include <glm/vec3.hpp>
#include <vector>

#include "mesh/tet_mesh.h"
#include "model/assembly/build_model.h"
#include "model/model.h"

namespace gelatin::test {

/// A block [0, size] of cells, six tets a cell; inner nodes moved at random by up to `jitter` of a cell.
TetMesh make_block(glm::ivec3 cells, glm::dvec3 size, double jitter = 0.0, unsigned seed = 1);

/// The default material with the paper's structural springs: for tests that do not care how stiff a body is.
Material structural_material();

/// A mesh without the tets round some places, and without nodes that no other tet has.
TetMesh without(const TetMesh& mesh, const std::function<bool(const glm::dvec3&)>& leaves_out);

/// A body of that mesh.
Body make_body(TetMesh mesh, const Material& material = structural_material());

/// A model of one body, without colliders.
Model make_model(const Body& body, glm::dvec3 gravity = {0.0, 0.0, 0.0});

/// A jittered block at rest off the origin whose nodes then were moved and set in motion at random; 1,234-ish
/// nodes (no multiple of 64), damping, some pins, shear and flex springs too, a floor and a sphere in the
/// way.
Model make_lively_model(unsigned seed = 7);

/// The same with two handles, one of them released at 1 s, whose nodes move at random too, and with loads of
/// every kind, several of them on some nodes.
Model make_driven_model(unsigned seed = 7);

/// Two blocks moved and set in motion at random, so much that some of their tets are inside out: one of
/// springs, one neo-Hookean with some pins; with damping or without, on a floor; no multiple of 64 nodes.
Model make_lively_tets(double damping_time, unsigned seed = 7);

/// Springs between points, as a model without tets or faces: for closed-form cases.
struct Net {
    std::vector<glm::dvec3> positions;   ///< [m]
    std::vector<glm::dvec3> velocities;  ///< [m/s]
    std::vector<double> masses;          ///< [kg]; infinite pins
    std::vector<Spring> springs;
    double damping_time = 0.0;  ///< [s]
    glm::dvec3 gravity{0.0};    ///< [m/s^2]
    std::vector<Collider> colliders;
};
Model make_model(const Net& net);

/// Two nodes of 1 kg (reduced mass 1/2) at x = -+(rest_length + stretch) / 2, at rest.
Net make_oscillator(double stiffness, double rest_length, double stretch);

}  // namespace gelatin::test
