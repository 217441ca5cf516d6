#pragma once

#include "core/current_stage.h"
#include "core/stage_timer.h"

namespace gelatin {

/// A stage of a step, or a part of one, while it lives: named for reports, and timed where stages are.
class Stage {
public:
    /// `name` must outlive it.
    Stage(StageTimer& timer, const char* name) : Stage(timer.for_stages(), name) {}
    /// @param timer of a part StageTimer::for_parts; null: it is not timed
    Stage(StageTimer* timer, const char* name) : current_(name), timed_(timer, name) {}

private:
    CurrentStage current_;
    TimedStage timed_;
};

}  // namespace gelatin
