#pragma once

#include <chrono>
#include <map>
#include <string>
#include <vector>

namespace gelatin {

/// Durations of a stage, in the order of measurement [ms].
using StageTimes = std::map<std::string, std::vector<double>>;

/// Times named stages of a step, and stages within stages.
class StageTimer {
public:
    virtual ~StageTimer() = default;
    virtual void begin(const std::string& stage) = 0;
    /// Ends the stage that began last.
    virtual void end() = 0;

    /// Whether stages are timed, at first not.
    void time_stages(bool times_stages) { times_stages_ = times_stages; }
    /// Null if stages are not timed.
    StageTimer* for_stages() { return times_stages_ ? this : nullptr; }

    /// Whether stages that have parts time them too.
    void time_parts(bool times_parts) { times_parts_ = times_parts; }
    /// For a stage's parts: null if they are not timed.
    StageTimer* for_parts() { return times_parts_ ? this : nullptr; }

    /// The measurements since the last call; for a device these may lag behind.
    virtual StageTimes take() = 0;

private:
    bool times_stages_ = false, times_parts_ = false;
};

/// Times by the host's clock, for work that is complete when the call returns.
class HostStageTimer : public StageTimer {
public:
    void begin(const std::string& stage) override;
    void end() override;
    StageTimes take() override;

private:
    struct Open {
        std::string stage;
        std::chrono::steady_clock::time_point start;
    };
    std::vector<Open> open_;
    StageTimes times_;
};

/// Times a stage while it lives.
class TimedStage {
public:
    /// @param timer null: the stage is not timed
    TimedStage(StageTimer* timer, const char* stage) : timer_(timer) {
        if (timer_ != nullptr) timer_->begin(stage);
    }
    TimedStage(const TimedStage&) = delete;
    TimedStage& operator=(const TimedStage&) = delete;
    ~TimedStage() {
        if (timer_ != nullptr) timer_->end();
    }

private:
    StageTimer* timer_;
};

}  // namespace gelatin
