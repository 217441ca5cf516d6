#include "recorder.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <numeric>

#include "gelatin/error.h"
#include "render/image.h"

namespace gelatin {
namespace {

struct Rational {
    int numerator, denominator;
};

// Pictures a second of a film in real time: frame_rate / interval, which decimals up to 1e-6 give exactly.
Rational film_rate(double frame_rate, int interval) {
    std::int64_t scale = 1;
    while (scale < 1'000'000 &&
           std::floor(frame_rate * static_cast<double>(scale)) != frame_rate * static_cast<double>(scale)) {
        scale *= 10;
    }
    const double scaled = std::round(frame_rate * static_cast<double>(scale));
    constexpr double kMost = std::numeric_limits<int>::max();
    if (scaled >= 1.0 && scaled <= 1e15) {
        const auto above = static_cast<std::int64_t>(scaled);
        const std::int64_t below = scale * interval;
        const std::int64_t common = std::gcd(above, below);
        if (static_cast<double>(above / common) <= kMost && static_cast<double>(below / common) <= kMost) {
            return {static_cast<int>(above / common), static_cast<int>(below / common)};
        }
    }
    throw InvalidInput(
        fmt::format("a film of every {} of {} frames a second has a rate that no player takes: choose "
                    "another --every",
                    interval, frame_rate));
}

}  // namespace

Recorder::Recorder(const RunOptions& options, Simulator& simulator)
    : options_(options),
      simulator_(simulator),
      interval_(record_interval(options, simulator.scene().simulation.frame_rate)) {
    const PictureSize size = picture_size(options);
    if (options.draws()) painter_ = std::make_unique<ScenePainter>(simulator, size);
    if (!options.video.empty()) {
        const Rational rate = film_rate(simulator.scene().simulation.frame_rate, interval_);
        grabber_ = std::make_unique<render::FrameGrabber>(size.width, size.height);
        video_ = std::make_unique<render::VideoWriter>(options.video, size.width, size.height, rate.numerator,
                                                       rate.denominator);
    }
    if (!options.export_folder.empty()) {
        exporter_ =
            std::make_unique<FrameExporter>(options.export_folder, export_format(options), simulator.model());
    }
}

void Recorder::record() {
    if (simulator_.frame() % interval_ != 0) return;
    if (video_) {
        painter_->draw();
        film(grabber_->grab(painter_->framebuffer()));
    }
    if (exporter_) exporter_->write(simulator_.read_frame());
}

void Recorder::finish() {
    if (video_) {
        film(grabber_->flush());
        video_->finish();
        video_.reset();
    }
    if (!options_.image.empty()) write_image();
}

void Recorder::film(std::optional<render::Image> picture) {
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
