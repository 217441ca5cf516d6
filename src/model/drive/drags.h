#pragma once

#include <memory>
#include <span>
#include <vector>

#include "gelatin/drag.h"
#include "model/model.h"

namespace gelatin {

/// How fast a dragged handle follows: its distance from where it shall be shrinks at this rate [1/s].
constexpr double kDragRate = 14.0;

/// Where `drag` is a step of `step` seconds nearer to `target`: as fast as kDragRate says, but no node faster
/// than Handle::most_speed, so that the body can follow, and never so slow that it does not arrive.
Drag follow(const Drag& drag, const Drag& target, const Handle& handle, double step);

/// The drag that brings the nodes of a handle, at `arms` from its pivot when they start, nearest to `places`
/// (least squares; B. K. P. Horn, Journal of the Optical Society of America A 4, 1987).
/// @pre one place for each arm, > 0
Drag nearest_drag(const HandlePose& pose, std::span<const glm::dvec3> arms,
                  std::span<const glm::dvec3> places);

/// How far a run's handles and pins have been dragged, and are to be. What nobody has dragged is where the
/// scene has it, and costs nothing.
class Drags {
public:
    explicit Drags(std::shared_ptr<const Model> model);

    /// Back to the start, where scenes drag what their handles say.
    void restart();

    /// Goes on with drags of shape [handles], and their targets.
    void go_on_with(std::vector<Drag> drags, std::vector<Drag> targets);

    const std::vector<Drag>& drags() const { return drags_; }
    const std::vector<Drag>& targets() const { return targets_; }

    void set_target(std::size_t handle, const Drag& target);

    /// False where no node of a pin or a handle has ever moved or will, as long as nobody drags one.
    bool may_move() const { return has_moving_ || is_dragged_; }
    /// True if something is on its way, and the next advance() moves it.
    bool is_under_way() const { return drags_ != targets_; }

    /// The motions of all handles over the step of `step` seconds that begins at `time`, during which they
    /// follow their targets.
    std::vector<HandleMotion> advance(double time, double step);

private:
    std::shared_ptr<const Model> model_;
    bool has_moving_;          // handles that move or let go by themselves
    bool is_dragged_ = false;  // some, since the run began
    std::vector<Drag> drags_, targets_;
};

}  // namespace gelatin
