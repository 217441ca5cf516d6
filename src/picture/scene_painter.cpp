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
    const render::Surroundings surroundings = describe_surroundings(simulator);
    const float aspect = static_cast<float>(size.width) / static_cast<float>(size.height);
    camera_ = choose_camera(simulator.scene(), surroundings, aspect);
    renderer_.set_surroundings(surroundings);
}

void ScenePainter::set_camera(const CameraDescription& camera) {
    camera_ = camera_of(camera);
}

}  // namespace gelatin
