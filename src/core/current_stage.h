#pragma once

#include <utility>

namespace gelatin {

/// Names what the thread is doing while it lives, for reports: a stage of a step. `name` must outlive it.
class CurrentStage {
public:
    explicit CurrentStage(const char* name) : outer_(std::exchange(current_, name)) {}
    CurrentStage(const CurrentStage&) = delete;
    CurrentStage& operator=(const CurrentStage&) = delete;
    ~CurrentStage() { current_ = outer_; }

    /// "" outside of all.
    static const char* name() { return current_; }

private:
    static inline thread_local const char* current_ = "";
    const char* outer_;
};

}  // namespace gelatin
