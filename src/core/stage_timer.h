#pragma once

#include <chrono>
#include <map>
#include <string>
#include <vector>

namespace gelatin {

/// Durations of a stage, in the order they were measured [ms].
using StageTimes = std::map<std::string, std::vector<double>>;

/// Times named stages of a step, one at a time.
class StageTimer {
public:
    virtual ~StageTimer() = default;
    virtual void begin(const std::string& stage) = 0;
    virtual void end() = 0;

    /// What was measured since the last call; may lag behind where a device measures.
    virtual StageTimes take() = 0;
};

/// Times on the host's clock: for work that is done when the call returns.
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
