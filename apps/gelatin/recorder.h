#pragma once

#include <memory>
#include <optional>

#include "common/frame_pipeline.h"
#include "film_frames.h"
#include "gelatin/recording.h"
#include "gelatin/simulator.h"
#include "picture/scene_painter.h"
#include "render/frame_grabber.h"
#include "render/video_writer.h"
#include "run_options.h"
#include "sim/animation/animation_file.h"
#include "sim/export.h"

namespace gelatin {

/// Records a run, or what a recording plays: the film, the exported frames, the picture of the last frame,
/// and the recording. The film of a run whose scene has no camera is drawn at the end, when it is known where
/// bodies have been.
///
/// Needs the simulator's context. Without `finish` there is no film at all.
class Recorder {
public:
    /// @throws InvalidInput for a film whose rate no player supports; SystemError if ffmpeg cannot be
    ///   started.
    Recorder(const RunOptions& options, Simulator& simulator);

    /// Records the present frame if it is due.
    void record();

    /// The same, and advances the simulator by a frame, concurrently with drawing if possible.
    void record_and_advance();

    /// Ends the film and draws the image.
    void finish();

private:
    bool is_due() const;
    void keep(bool is_last);
    void write_frame();
    void animate(const HostFrame& frame);
    void film(const RenderView& bodies);
    void film_at_end();
    void write(std::optional<render::Image> picture);
    void write_image();

    const RunOptions& options_;
    Simulator& simulator_;
    int spacing_;   // frames from one that is played to the next
    int interval_;  // of those, from one that is filmed and exported to the next
    int kept_;      // frames from one that is recorded to the next
    int played_ = 0;
    std::unique_ptr<ScenePainter> painter_;
    std::unique_ptr<render::FrameGrabber> grabber_;
    std::unique_ptr<render::VideoWriter> video_;
    std::unique_ptr<FilmFrames> film_frames_;  // of a film whose camera they decide
    std::unique_ptr<FrameExporter> exporter_;
    std::unique_ptr<AnimationFile> animation_;
    bool is_animated_ = false;  // it has a frame
    std::optional<RecordingWriter> recording_;
    std::optional<int> recorded_;  // frame
    FramePipeline pipeline_;
};

}  // namespace gelatin
