#pragma once

#include <chrono>
#include <map>
#include <string>
#include <vector>

namespace gelatin {

/// Durations of a stage, in the order of measurement [ms].
using StageTimes = std::map<std::string, std::vector<double>>;

/// Times named stages of a step, one at a time.
class StageTimer {
public:
    virtual ~StageTimer() = default;
    virtual void begin(const std::string& stage) = 0;
    virtual void end() = 0;

    /// The measurements since the last call; for a device these may lag behind.
    virtual StageTimes take() = 0;
};

/// Times by the host's clock, for work that is complete when the call returns.
class HostStageTimer : public StageTimer {
public:
    void begin(const std::string& stage) override;
    void end() override;
    StageTimes take() override;

private:
    std::string stage_;
    std::chrono::steady_clock::time_point start_;
    StageTimes times_;
};

}  // namespace gelatin
