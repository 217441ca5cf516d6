#pragma once

#include "core/current_stage.h"
#include "core/stage_timer.h"

namespace gelatin {

/// A stage of a step while it lives: named for reports, and timed where stages are.
class Stage {
public:
    /// `name` must outlive it.
    Stage(StageTimer& timer, const char* name) : current_(name), timed_(timer.for_stages(), name) {}

private:
    CurrentStage current_;
    TimedStage timed_;
};

}  // namespace gelatin
