#pragma once

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <limits>
#include <vector>

#include "gelatin/scene.h"
#include "model/layouts.h"

namespace gelatin {

struct Model;
struct ModelObject;

/// What moves a group of nodes: see HandleDescription.
struct Handle {
    glm::dvec3 pivot{0.0};  ///< at the start [m]
    Interpolation interpolation = Interpolation::linear;
    std::vector<Keyframe> keyframes;
    double release = std::numeric_limits<double>::infinity();  ///< [s]
};

/// Adds a handle to the model, with the nodes that its region holds: these get the inverse mass 0 and rest.
/// @param positions at the start, of the nodes from `first_node` on [m]
void append_handle(const HandleDescription& description, const std::vector<glm::dvec3>& positions,
                   std::uint32_t first_node, Model& model);

/// Where a handle takes a node that starts at pivot + arm: center + map arm.
struct HandlePose {
    glm::dvec3 center;  ///< [m]
    glm::dmat3 map;     ///< turn and scale
};
HandlePose pose_at(const Handle& handle, double time);

/// The motions of all handles over the step of `step` seconds that begins at `time`. A node is free from the
/// first step on that begins nearer to its release than half a step, or later.
std::vector<HandleMotion> handle_motions(const std::vector<Handle>& handles, double time, double step);

/// True if a handle moves or lets go between two times [s]: else those that hold something are like pins.
/// @param step as above
bool any_acts(const std::vector<Handle>& handles, double from, double until, double step);

/// Inverse masses of an object's nodes [1/kg], all handles that ever let go having done so.
std::vector<double> free_inverse_masses(const Model& model, const ModelObject& object);

}  // namespace gelatin
