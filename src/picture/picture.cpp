#include "gelatin/picture.h"

#include <utility>

#include "gl/host_state.h"
#include "model/scene/validation.h"
#include "picture/scene_painter.h"
#include "render/frame_grabber.h"
#include "render/image.h"
#include "sim/simulator_internals.h"

namespace gelatin {
namespace {

render::Quality quality_of(PictureQuality quality) {
    switch (quality) {
        case PictureQuality::high:
            return render::Quality::high;
        case PictureQuality::fast:
            return render::Quality::fast;
        case PictureQuality::automatic:
            break;
    }
    return render::Quality::automatic;
}

// @throws NoOpenGl, before anything calls OpenGL
Simulator& with_context(Simulator& simulator) {
    simulator.render_view();
    return simulator;
}

}  // namespace

struct PicturePainter::Impl {
    Impl(Simulator& s, const PictureOptions& options)
        : simulator(with_context(s)),
          painter(s, {options.width, options.height}, quality_of(options.quality), options.overlays),
          grabber(options.width, options.height) {
        if (options.camera) painter.set_camera(*options.camera);
    }

    Simulator& simulator;
    ScenePainter painter;
    render::FrameGrabber grabber;
};

PicturePainter::PicturePainter(Simulator& simulator, const PictureOptions& options) {
    if (options.camera) check_camera(*options.camera);
    const auto host = SimulatorInternals::keep_host_state(simulator);
    impl_ = std::make_unique<Impl>(simulator, options);
}

PicturePainter::PicturePainter(PicturePainter&&) noexcept = default;
PicturePainter& PicturePainter::operator=(PicturePainter&&) noexcept = default;
PicturePainter::~PicturePainter() = default;

void PicturePainter::set_camera(const CameraDescription& camera) {
    check_camera(camera);
    impl_->painter.set_camera(camera);
}

void PicturePainter::set_overlays(const Overlays& overlays) {
    impl_->painter.set_overlays(overlays);
}

Picture PicturePainter::paint() {
    const auto host = SimulatorInternals::keep_host_state(impl_->simulator);
    impl_->painter.draw();
    impl_->grabber.grab(impl_->painter.framebuffer());
    render::Image image = std::move(*impl_->grabber.flush());
    return {image.width, image.height, std::move(image.pixels)};
}

Picture render_picture(Simulator& simulator, const PictureOptions& options) {
    return PicturePainter(simulator, options).paint();
}

void save_picture(const std::filesystem::path& file, const Picture& picture) {
    render::Image image(picture.width, picture.height);
    image.pixels = picture.pixels;
    render::write_png(file, image);
}

}  // namespace gelatin
