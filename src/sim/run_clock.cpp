#include "sim/run_clock.h"

#include <cmath>

namespace gelatin {

void RunClock::go_on_from(const Moment& moment) {
    start_ = moment;
    steps_ = 0;
    const auto whole = static_cast<std::uint64_t>(std::llround(moment.time / step_size()));
    const bool same_steps =
        moment.frame == static_cast<int>(whole / static_cast<std::uint64_t>(substeps_)) &&
        std::abs(static_cast<double>(whole) * step_size() - moment.time) <= 1e-6 * step_size();
    if (!same_steps) return;
    start_ = {};
    steps_ = whole;
}

Moment RunClock::now() const {
    return {start_.frame + static_cast<int>(steps_ / static_cast<std::uint64_t>(substeps_)),
            start_.time + static_cast<double>(steps_) * step_size(), start_.steps + steps_};
}

}  // namespace gelatin
