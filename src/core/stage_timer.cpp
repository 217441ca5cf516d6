#include "core/stage_timer.h"

#include <utility>

namespace gelatin {

void HostStageTimer::begin(const std::string& stage) {
    stage_ = stage;
    start_ = std::chrono::steady_clock::now();
}

void HostStageTimer::end() {
    const std::chrono::duration<double, std::milli> elapsed = std::chrono::steady_clock::now() - start_;
    times_[stage_].push_back(elapsed.count());
}

StageTimes HostStageTimer::take() {
    return std::exchange(times_, {});
}

}  // namespace gelatin
