#include "model/drive/handle_clocks.h"

#include <cmath>

#include "model/drive/handle_animation.h"

namespace gelatin {
namespace {

// Whether the handle still moves after this time of its own, or releases its nodes.
bool has_more_to_do(const Handle& handle, double time) {
    const bool will_release = std::isfinite(handle.release) && time < handle.release;
    const bool is_animated = handle.animation && time < handle.animation->end();
    return will_release || is_animated || (!handle.keyframes.empty() && time < handle.keyframes.back().time);
}

}  // namespace

void HandleClocks::restart() {
    go_on_with(std::vector<double>(model_->handles.size()));
}

void HandleClocks::go_on_with(std::vector<double> delays) {
    delays_ = std::move(delays);
    is_held_up_.assign(model_->handles.size(), 0);
}

void HandleClocks::set_held_up(std::span<const std::uint32_t> handles) {
    is_held_up_.assign(is_held_up_.size(), 0);
    for (const std::uint32_t h : handles) is_held_up_[h] = 1;
}

std::vector<double> HandleClocks::times(double time) const {
    std::vector<double> times;
    for (const double delay : delays_) times.push_back(time - delay);
    return times;
}

HandleTimes HandleClocks::advance(double time, double step) {
    HandleTimes times{this->times(time), {}};
    for (std::size_t h = 0; h < delays_.size(); ++h) {
        const Handle& handle = model_->handles[h];
        if (handle.stops && is_held_up_[h] != 0 && has_more_to_do(handle, times.begin[h])) {
            delays_[h] += step;
            times.end.push_back(times.begin[h]);
        } else {
            times.end.push_back(time + step - delays_[h]);
        }
    }
    return times;
}

bool HandleClocks::late_ones_act(const HandleTimes& times, double step) const {
    for (std::size_t h = 0; h < delays_.size(); ++h) {
        if (delays_[h] > 0.0 && acts(model_->handles[h], times.begin[h], times.end[h], step)) return true;
    }
    return false;
}

}  // namespace gelatin
