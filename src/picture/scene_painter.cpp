#include "picture/scene_painter.h"

#include "picture/surroundings.h"

namespace gelatin {
namespace {

render::RendererOptions renderer_options(const PictureSize& size, render::Quality quality) {
    render::RendererOptions options;
    options.width = size.width;
    options.height = size.height;
    options.quality = quality;
    return options;
}

}  // namespace

ScenePainter::ScenePainter(Simulator& simulator, const PictureSize& size, render::Quality quality,
                           const Overlays& overlays)
    : simulator_(simulator), overlays_(overlays), renderer_(renderer_options(size, quality)) {
    show(Shown::of_all(simulator));
}

void ScenePainter::show(const Shown& shown) {
    const float aspect = static_cast<float>(renderer_.width()) / static_cast<float>(renderer_.height());
    camera_ = shown.camera(aspect);
    renderer_.set_surroundings(describe_surroundings(simulator_, shown));
}

void ScenePainter::set_camera(const CameraDescription& camera) {
    camera_ = camera_of(camera);
}

}  // namespace gelatin
