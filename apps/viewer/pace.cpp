#include "pace.h"

#include <algorithm>
#include <cmath>

namespace gelatin::viewer {
namespace {

constexpr double kBudget = 1.0 / 30.0;  // for the steps between two pictures [s]
constexpr double kLongestDelay = 0.1;   // largest delay of the window that is made up for [s]
constexpr double kMemory = 0.5;         // interval over which the achieved speed is averaged [s]
constexpr double kCostMemory = 0.2;     // weight of the newest cost in the mean

}  // namespace

void Pace::note_cost(double seconds_a_step) {
    cost_ = cost_ == 0.0 ? seconds_a_step : cost_ + kCostMemory * (seconds_a_step - cost_);
}

int Pace::most_steps() const {
    return cost_ > 0.0 ? static_cast<int>(std::clamp(kBudget / cost_, 1.0, 1e6)) : 1;
}

int Pace::steps_for(double elapsed) {
    due_ += speed_ * std::min(elapsed, kLongestDelay);
    // The sum of many frames' times may be a rounding error short of a step.
    const double wanted = std::floor(due_ / step_size_ + 1e-9);
    const double steps = std::min(wanted, static_cast<double>(most_steps()));
    due_ = std::clamp(due_ - steps * step_size_, 0.0, step_size_);

    const double fading = std::exp(-elapsed / kMemory);
    elapsed_ = fading * elapsed_ + elapsed;
    simulated_ = fading * simulated_ + steps * step_size_;
    return static_cast<int>(steps);
}

void Pace::restart() {
    due_ = elapsed_ = simulated_ = 0.0;
}

double Pace::achieved_speed() const {
    // Before some steps were due there is no estimate.
    const bool is_known = elapsed_ > 0.5 * kMemory && elapsed_ * speed_ > 2.0 * step_size_;
    return is_known ? std::min(simulated_ / elapsed_, speed_) : speed_;
}

}  // namespace gelatin::viewer
