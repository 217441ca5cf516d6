#include "core/stage_timer.h"

#include <utility>

namespace gelatin {

void HostStageTimer::begin(const std::string& stage) {
    open_.push_back({stage, std::chrono::steady_clock::now()});
}

void HostStageTimer::end() {
    const auto now = std::chrono::steady_clock::now();
    const std::chrono::duration<double, std::milli> elapsed = now - open_.back().start;
    times_[open_.back().stage].push_back(elapsed.count());
    open_.pop_back();
}

StageTimes HostStageTimer::take() {
    return std::exchange(times_, {});
}

}  // namespace gelatin
