#pragma once

#include "gelatin/simulator.h"
#include "picture/picture_size.h"
#include "picture/shown.h"
#include "render/renderer.h"

namespace gelatin {

/// Draws a simulator's bodies with its scene's floor, colliders and camera. The highest level plane is the
/// floor.
///
/// Needs the simulator's context, which must outlive it.
class ScenePainter {
public:
    /// Shows the present state, or all frames of a recording.
    ScenePainter(Simulator& simulator, const PictureSize& size, render::Quality quality,
                 const Overlays& overlays = {});

    /// Sets floor and light for all of this, and, if the scene has no camera, the camera.
    void show(const Shown& shown);

    /// The present state with the overlays.
    RenderView view() { return simulator_.render_view(overlays_); }

    /// Draws the present state.
    void draw() { draw(view()); }

    /// Draws `view`, without access to the simulator.
    void draw(const RenderView& bodies) { renderer_.draw(bodies, camera_); }

    void set_camera(const CameraDescription& camera);
    void set_overlays(const Overlays& overlays) { overlays_ = overlays; }

    unsigned framebuffer() const { return renderer_.framebuffer(); }

private:
    Simulator& simulator_;
    Overlays overlays_;
    render::Renderer renderer_;
    render::Camera camera_;
};

}  // namespace gelatin
