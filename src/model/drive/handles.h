#pragma once

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <limits>
#include <memory>
#include <span>
#include <vector>

#include "gelatin/drag.h"
#include "gelatin/scene.h"
#include "model/layouts.h"

namespace gelatin {

struct HandleAnimation;
struct Model;
struct ModelObject;

/// A group of nodes that moves together: see HandleDescription. A pin is one without keyframes. Skeletons and
/// colliders that move are others.
struct Handle {
    glm::dvec3 pivot{0.0};  ///< at the start [m]
    Interpolation interpolation = Interpolation::linear;
    std::vector<Keyframe> keyframes;
    double release = std::numeric_limits<double>::infinity();  ///< [s]
    bool stops = false;  ///< its time stands still while bodies hold it up (WhenBlocked)

    std::size_t object = 0;  ///< index in Model::objects
    bool is_pin = false;     ///< from ObjectDescription::pins, otherwise from its handles
    bool is_added = false;   ///< a pin of a program (with_pins)
    std::size_t index = 0;   ///< index there
    std::size_t count = 0;   ///< number of nodes
    glm::dvec3 middle{0.0};  ///< the nodes' centre at the start, relative to the pivot [m]
    /// Moves its nodes beside the keyframes; null: arms stay as they are.
    std::shared_ptr<const HandleAnimation> animation = {};

    double radius = 0.0;      ///< largest distance of a node from the pivot at the start [m]
    Drag drag;                ///< the drag that it approaches from the start on
    double most_speed = 0.0;  ///< largest speed of a node in a drag [m/s], > 0
};

/// The placement of a handle: a node that starts at pivot + arm is at center + map arm.
struct HandlePose {
    glm::dvec3 center;  ///< [m]
    glm::dmat3 map;     ///< rotation and scale

    glm::dvec3 place(const glm::dvec3& arm) const { return center + map * arm; }
};
HandlePose pose_at(const Handle& handle, double time);
/// The same with a drag.
HandlePose pose_at(const Handle& handle, double time, const Drag& drag);

/// The times at which handles are at the two ends of a step [s], shape [handles]: the simulation's, but
/// earlier for those that have stood still (HandleClocks).
struct HandleTimes {
    std::vector<double> begin, end;
};

/// The motions of all handles over the step of `step` seconds that begins at `time`. A node is released at
/// the step that begins nearest to its release.
std::vector<HandleMotion> handle_motions(const std::vector<Handle>& handles, double time, double step);
/// The same with the drags at the start and at the end of the step, each of shape [handles], at times of
/// their own.
std::vector<HandleMotion> handle_motions(const std::vector<Handle>& handles, std::span<const Drag> before,
                                         std::span<const Drag> after, const HandleTimes& times, double step);

/// False if it has released its nodes by the step that begins at `time` and takes `step` seconds.
bool is_held(const Handle& handle, double time, double step);

/// True if a handle moves or releases its nodes between two times [s]: otherwise those that hold nodes are
/// like pins.
/// @param step as above
bool any_acts(const std::vector<Handle>& handles, double from, double until, double step);
/// The same of one.
bool acts(const Handle& handle, double from, double until, double step);

/// Inverse masses of an object's nodes [1/kg], after all handles with a release have released theirs.
std::vector<double> free_inverse_masses(const Model& model, const ModelObject& object);

}  // namespace gelatin
