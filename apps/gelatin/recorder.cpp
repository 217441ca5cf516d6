#include "recorder.h"

#include <fmt/core.h>

#include <algorithm>
#include <cstdio>
#include <numeric>

#include "common/progress.h"
#include "core/log.h"
#include "interrupt.h"
#include "overlay_option.h"
#include "render/collider_props.h"
#include "render/image.h"
#include "render/palette.h"
#include "sim/simulator_internals.h"

namespace gelatin {
namespace {

// Pictures per second of a film in real time.
render::FrameRate film_rate(double frame_rate, int interval) {
    constexpr double kLargest = 1e6;  // beyond this, numerator or denominator overflow int
    const render::FrameRate rounded = render::FrameRate::from(frame_rate / interval);
    if (frame_rate > kLargest || interval > kLargest) return rounded;
    const render::FrameRate all = render::FrameRate::from(frame_rate);
    const int common = std::gcd(all.numerator, interval);
    return {all.numerator / common, all.denominator * (interval / common)};
}

// Frames of the simulation from one that a recording has to the next; 1 where none is played. The first one
// may be any.
int recorded_spacing(const Simulator& simulator) {
    const Recording* const recording = simulator.recording();
    if (recording == nullptr || recording->frame_count() < 2) return 1;
    const std::size_t k = recording->frame_count() > 2 ? 2 : 1;
    return std::max(1, recording->frame(k) - recording->frame(k - 1));
}

// By the frames of the run; those of a recording are known.
bool chooses_camera(const Simulator& simulator) {
    return !simulator.scene().camera && simulator.recording() == nullptr;
}

std::vector<glm::vec3> object_colors(const Model& model) {
    std::vector<glm::vec3> colors;
    for (std::size_t o = 0; o < model.objects.size(); ++o) {
        const glm::vec3 given = model.is_body(o) ? model.objects[o].color : render::kPropColor;
        colors.push_back(given.r < 0.0f ? render::palette_color(o) : given);
    }
    return colors;
}

}  // namespace

Recorder::Recorder(const RunOptions& options, Simulator& simulator)
    : options_(options),
      simulator_(simulator),
      spacing_(recorded_spacing(simulator)),
      interval_(record_interval(options, simulator.scene().simulation.frame_rate / spacing_)),
      kept_(options.every.value_or(1)),
      pipeline_(simulator) {
    const PictureSize size = picture_size(options);
    if (options.draws()) {
        painter_ = std::make_unique<ScenePainter>(simulator, size, picture_quality(options),
                                                  parse_overlays(options.overlays));
    }
    if (!options.video.empty()) {
        grabber_ = std::make_unique<render::FrameGrabber>(size.width, size.height);
        video_ = std::make_unique<render::VideoWriter>(
            options.video, size.width, size.height,
            film_rate(simulator.scene().simulation.frame_rate, spacing_ * interval_));
        if (chooses_camera(simulator)) film_frames_ = std::make_unique<FilmFrames>(options.video, simulator);
    }
    if (!options.export_folder.empty()) {
        exporter_ = std::make_unique<FrameExporter>(options.export_folder, export_format(options),
                                                    model_of(simulator));
    }
    if (!options.animation.empty()) {
        animation_ = make_animation_file(
            options.animation, model_of(simulator_),
            {simulator_.scene().simulation.frame_rate, object_colors(model_of(simulator_)),
             simulator_.scene().up, simulator_.scene().attachments});
    }
    if (!options.record.empty()) recording_.emplace(options.record, simulator_);
}

// The last frame, too, from which a run can continue.
void Recorder::keep(bool is_last) {
    const int frame = simulator_.frame();
    if (!recording_ || recorded_ == frame || (!is_last && frame % kept_ != 0)) return;
    recording_->write(simulator_);
    recorded_ = frame;
}

// Of a recording, the first frame that is played is.
bool Recorder::is_due() const {
    return (simulator_.recording() != nullptr ? played_ : simulator_.frame()) % interval_ == 0;
}

void Recorder::record() {
    keep(true);
    if (is_due()) {
        if (film_frames_) {
            film_frames_->add(simulator_);
        } else if (video_) {
            film(painter_->view());
        }
        write_frame();
    } else if (animation_ && !is_animated_) {
        animate(simulator_.read_frame());  // no frame was due, but a file is expected
    }
}

void Recorder::record_and_advance() {
    keep(false);
    const bool is_due = this->is_due();
    ++played_;
    if (is_due) write_frame();
    if (is_due && film_frames_) film_frames_->add(simulator_);
    if (!is_due || !video_ || film_frames_) return simulator_.advance_frame();
    const RenderView bodies = painter_->view();
    pipeline_.advance_beside([&] { film(bodies); });
}

void Recorder::finish() {
    if (film_frames_) film_at_end();
    if (video_) {
        write(grabber_->flush());
        video_->finish();
        video_.reset();
    }
    if (!options_.image.empty()) write_image();
    if (is_animated_) animation_->finish();
    if (recording_) recording_->finish();
}

// No frame with invalid numbers is exported.
void Recorder::write_frame() {
    if (!exporter_ && !animation_) return;
    simulator_.check();
    const HostFrame frame = simulator_.read_frame();
    if (exporter_) exporter_->write(frame);
    if (animation_) animate(frame);
}

void Recorder::animate(const HostFrame& frame) {
    animation_->write(frame);
    is_animated_ = true;
}

void Recorder::film(const RenderView& bodies) {
    painter_->draw(bodies);
    write(grabber_->grab(painter_->framebuffer()));
}

void Recorder::film_at_end() {
    if (film_frames_->is_empty()) return;
    Simulator player = film_frames_->play(simulator_);
    painter_->show(Shown::of_all(player));
    const Overlays overlays = parse_overlays(options_.overlays);
    if (!options_.quiet) std::fprintf(stderr, "gelatin: drawing the film\n");
    const Interrupt interrupt;
    const auto count = static_cast<int>(player.recording()->frame_count());
    Progress progress(0, count, options_.quiet);
    int k = 0;
    for (; k < count && !interrupt.was_asked(); ++k) {
        player.show_recorded(static_cast<std::size_t>(k));
        film(player.render_view(overlays));
        progress.update(k + 1);
    }
    if (k < count) log_warning(fmt::format("interrupted: the film ends after picture {} of {}", k, count));
}

void Recorder::write(std::optional<render::Image> picture) {
    if (picture) video_->write(*picture);
}

void Recorder::write_image() {
    const PictureSize size = picture_size(options_);
    render::FrameGrabber grabber(size.width, size.height);
    if (!simulator_.scene().camera && options_.video.empty()) painter_->show(Shown(simulator_));
    painter_->draw();
    grabber.grab(painter_->framebuffer());
    if (const auto picture = grabber.flush()) render::write_png(options_.image, *picture);
}

}  // namespace gelatin
