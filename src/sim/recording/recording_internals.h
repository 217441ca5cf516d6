#pragma once

#include "gelatin/recording.h"
#include "sim/recording/recorded_frame.h"

namespace gelatin {

/// What Simulator needs of recordings.
struct RecordingInternals {
    /// A frame, from the last one that was asked for or the last key frame.
    /// @throws InvalidInput if the model is not that of the recording, or the file is damaged
    static const RecordedFrame& frame(const Recording& recording, const Model& model, std::size_t index);
};

}  // namespace gelatin
