#pragma once

#include <array>
#include <deque>
#include <string>
#include <utility>
#include <vector>

#include "core/stage_timer.h"

namespace gelatin::gl {

/// Times stages on the GPU's clock by pairs of GL_TIMESTAMP queries (GL_TIME_ELAPSED reads 0 for compute on
/// llvmpipe). Never waits: results are taken when the driver has them, so `take` lags behind.
class TimestampStageTimer : public StageTimer {
public:
    TimestampStageTimer() = default;
    TimestampStageTimer(const TimestampStageTimer&) = delete;
    TimestampStageTimer& operator=(const TimestampStageTimer&) = delete;
    ~TimestampStageTimer() override;

    void begin(const std::string& stage) override;
    void end() override;
    StageTimes take() override;

    /// Waits for all pending queries; then `take` has everything.
    void finish();

private:
    struct Pending {
        std::string stage;
        unsigned start, stop;
    };
    unsigned new_query();
    void collect(bool wait);
    std::vector<unsigned> free_;
    std::deque<Pending> pending_;    // in the order in which they began
    std::size_t taken_ = 0;          // pending ones before pending_
    std::vector<std::size_t> open_;  // numbers of those that have not ended, the last one at the back
    StageTimes times_;
};

}  // namespace gelatin::gl
