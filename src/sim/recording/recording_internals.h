#pragma once

#include "gelatin/recording.h"
#include "sim/recording/recorded_frame.h"

namespace gelatin {

/// What Simulator needs of recordings.
struct RecordingInternals {
    /// To be called before frames are asked for. @throws InvalidInput if the model is not that of the
    /// recording
    static void require_fits(const Recording& recording, const Model& model);

    /// A frame, from the last one that was asked for or the last key frame.
    /// @throws InvalidInput if the file is damaged @pre the model fits
    static const RecordedFrame& frame(const Recording& recording, const Model& model, std::size_t index);
};

}  // namespace gelatin
