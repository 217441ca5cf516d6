#pragma once

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <limits>
#include <span>
#include <vector>

#include "gelatin/drag.h"
#include "gelatin/scene.h"
#include "model/layouts.h"

namespace gelatin {

struct Model;
struct ModelObject;

/// What moves a group of nodes: see HandleDescription. A pin is one without keyframes.
struct Handle {
    glm::dvec3 pivot{0.0};  ///< at the start [m]
    Interpolation interpolation = Interpolation::linear;
    std::vector<Keyframe> keyframes;
    double release = std::numeric_limits<double>::infinity();  ///< [s]

    std::size_t object = 0;   ///< index in Model::objects
    bool is_pin = false;      ///< one of ObjectDescription::pins, else of its handles
    std::size_t index = 0;    ///< there
    std::size_t count = 0;    ///< of its nodes
    glm::dvec3 middle{0.0};   ///< the nodes' centre at the start, from the pivot [m]
    double radius = 0.0;      ///< how far the farthest node then is from the pivot [m]
    Drag drag;                ///< where it is dragged to from the start on
    double most_speed = 0.0;  ///< while it is dragged [m/s], > 0
};

/// Where a handle takes a node that starts at pivot + arm: center + map arm.
struct HandlePose {
    glm::dvec3 center;  ///< [m]
    glm::dmat3 map;     ///< turn and scale

    glm::dvec3 place(const glm::dvec3& arm) const { return center + map * arm; }
};
HandlePose pose_at(const Handle& handle, double time);
/// The same, dragged.
HandlePose pose_at(const Handle& handle, double time, const Drag& drag);

/// The motions of all handles over the step of `step` seconds that begins at `time`. A node is free from the
/// first step on that begins nearer to its release than half a step, or later.
std::vector<HandleMotion> handle_motions(const std::vector<Handle>& handles, double time, double step);
/// The same, dragged so far when the step begins and so far when it ends, each of shape [handles].
std::vector<HandleMotion> handle_motions(const std::vector<Handle>& handles, std::span<const Drag> before,
                                         std::span<const Drag> after, double time, double step);

/// False once it has let go, in the step that begins at `time` and takes `step` seconds.
bool is_held(const Handle& handle, double time, double step);

/// True if a handle moves or lets go between two times [s]: else those that hold something are like pins.
/// @param step as above
bool any_acts(const std::vector<Handle>& handles, double from, double until, double step);

/// Inverse masses of an object's nodes [1/kg], all handles that ever let go having done so.
std::vector<double> free_inverse_masses(const Model& model, const ModelObject& object);

}  // namespace gelatin
