#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "model/model.h"

namespace gelatin {

/// The times of a run's handles, by which their keyframes and releases are. They are the simulation's, but
/// those of handles that stop (WhenBlocked) stand still in steps that begin while bodies hold them up, and
/// are late from then on.
class HandleClocks {
public:
    explicit HandleClocks(std::shared_ptr<const Model> model) : model_(std::move(model)) { restart(); }

    /// Returns to the start, when nothing is late.
    void restart();

    /// Continues with delays of shape [handles]; until set_held_up() nothing stands still.
    void go_on_with(std::vector<double> delays);

    /// By how much handles are late [s], >= 0, shape [handles].
    const std::vector<double>& delays() const { return delays_; }

    /// Which handles bodies block from now on; the others move.
    void set_held_up(std::span<const std::uint32_t> handles);

    /// The times of all handles when the simulation's is `time` [s].
    std::vector<double> times(double time) const;

    /// The times in the step of `step` seconds that begins at `time`. Handles that stand still in it are
    /// later from then on by the step, unless they have come to the end of all that they do.
    HandleTimes advance(double time, double step);

    /// Whether a handle that is late moves or releases its nodes in the step from `times.begin`.
    bool late_ones_act(const HandleTimes& times, double step) const;

private:
    std::shared_ptr<const Model> model_;
    std::vector<double> delays_;            // [s]
    std::vector<std::uint8_t> is_held_up_;  // by handle
};

}  // namespace gelatin
