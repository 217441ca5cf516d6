#pragma once

#include <memory>
#include <span>
#include <vector>

#include "gelatin/drag.h"
#include "model/model.h"

namespace gelatin {

/// How fast a dragged handle follows: its distance from the target decreases at this rate [1/s].
constexpr double kDragRate = 14.0;

/// The drag after a step of `step` seconds from `drag` towards `target`: at the rate kDragRate, but with no
/// node faster than Handle::most_speed, so that the body can follow, and fast enough to arrive.
Drag follow(const Drag& drag, const Drag& target, const Handle& handle, double step);

/// The drag that brings the nodes of a handle, at `arms` from its pivot at the start, nearest to `places`
/// (least squares; B. K. P. Horn, Journal of the Optical Society of America A 4, 1987).
/// @pre one place for each arm, > 0
Drag nearest_drag(const HandlePose& pose, std::span<const glm::dvec3> arms,
                  std::span<const glm::dvec3> places);

/// The present drags of a run's handles and pins, and their targets. What nobody has dragged is where the
/// scene has it, and costs nothing.
class Drags {
public:
    explicit Drags(std::shared_ptr<const Model> model);

    /// Returns to the start, with the drags that the scene's handles have.
    void restart();

    /// Continues with drags of shape [handles], and their targets.
    void go_on_with(std::vector<Drag> drags, std::vector<Drag> targets);

    const std::vector<Drag>& drags() const { return drags_; }
    const std::vector<Drag>& targets() const { return targets_; }

    void set_target(std::size_t handle, const Drag& target);

    /// False if no node of a pin or a handle has ever moved or will move, unless somebody drags one.
    bool may_move() const { return has_moving_ || is_dragged_; }
    /// True if a drag has not reached its target, so that the next advance() changes it.
    bool is_under_way() const { return drags_ != targets_; }

    /// The motions of all handles over a step of `step` seconds between these times, in which they approach
    /// their targets.
    std::vector<HandleMotion> advance(const HandleTimes& times, double step);

private:
    std::shared_ptr<const Model> model_;
    bool has_moving_;          // whether handles move or release their nodes by themselves
    bool is_dragged_ = false;  // whether any was dragged since the run began
    std::vector<Drag> drags_, targets_;
};

}  // namespace gelatin
