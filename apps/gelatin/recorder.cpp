#include "recorder.h"

#include <numeric>

#include "overlay_option.h"
#include "render/image.h"
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

}  // namespace

Recorder::Recorder(const RunOptions& options, Simulator& simulator)
    : options_(options),
      simulator_(simulator),
      interval_(record_interval(options, simulator.scene().simulation.frame_rate)),
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
            film_rate(simulator.scene().simulation.frame_rate, interval_));
    }
    if (!options.export_folder.empty()) {
        exporter_ = std::make_unique<FrameExporter>(options.export_folder, export_format(options),
                                                    model_of(simulator));
    }
}

bool Recorder::is_due() const {
    return simulator_.frame() % interval_ == 0;
}

void Recorder::record() {
    if (!is_due()) return;
    if (video_) film(painter_->view());
    if (exporter_) export_frame();
}

void Recorder::record_and_advance() {
    if (!is_due()) return simulator_.advance_frame();
    if (exporter_) export_frame();
    if (!video_) return simulator_.advance_frame();
    const RenderView bodies = painter_->view();
    pipeline_.advance_beside([&] { film(bodies); });
}

void Recorder::finish() {
    if (video_) {
        write(grabber_->flush());
        video_->finish();
        video_.reset();
    }
    if (!options_.image.empty()) write_image();
}

// No frame with invalid numbers is recorded.
void Recorder::export_frame() {
    simulator_.check();
    exporter_->write(simulator_.read_frame());
}

void Recorder::film(const RenderView& bodies) {
    painter_->draw(bodies);
    write(grabber_->grab(painter_->framebuffer()));
}

void Recorder::write(std::optional<render::Image> picture) {
    if (picture) video_->write(*picture);
}

void Recorder::write_image() {
    const PictureSize size = picture_size(options_);
    render::FrameGrabber grabber(size.width, size.height);
    painter_->draw();
    grabber.grab(painter_->framebuffer());
    if (const auto picture = grabber.flush()) render::write_png(options_.image, *picture);
}

}  // namespace gelatin
