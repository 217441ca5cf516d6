#pragma once

#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <memory>
#include <optional>
#include <vector>

#include "gelatin/scene.h"
#include "gelatin/views.h"
#include "gl/buffer.h"
#include "mesh/surface_mesh.h"
#include "render/camera.h"
#include "render/high_pipeline.h"
#include "render/overlay.h"
#include "render/shadows.h"
#include "render/static_mesh.h"
#include "render/turned_view.h"

namespace gelatin::render {

/// high: light at each pixel, smooth edges. fast: light at each vertex as in the paper, small shadow maps, no
/// smoothing; about a tenth of the time on software drivers. automatic: fast on those, high on GPUs.
enum class Quality { automatic, high, fast };

struct RendererOptions {
    int width = 1280;  ///< [pixels], >= 1
    int height = 720;  ///< [pixels], >= 1
    Quality quality = Quality::automatic;
    Smoothing smoothing = Smoothing::automatic;  ///< ignored by Quality::fast
};

/// Of what bodies lie on and bounce off, linear RGB.
const glm::vec3 kPropColor(0.34f, 0.37f, 0.42f);

/// What does not change from frame to frame.
struct Surroundings {
    Bounds bounds;  ///< of the bodies at the start: sets the scale of floor and shadows [m]
    std::optional<float> floor_height;  ///< [m]; empty: no floor is drawn
    std::vector<SurfaceMesh> props;     ///< surfaces that do not move
    /// Of the bodies, linear RGB; the palette's if one is negative or missing.
    std::vector<glm::vec3> colors;
    Axis up = Axis::y;  ///< y or z: of all coordinates here, of the bodies and of cameras
};

/// Draws bodies from their buffers into its own picture: floor, backdrop, soft shadows.
///
/// Needs the context in which it was made and to which the buffers belong. Changes the state of OpenGL,
/// except the framebuffer and the viewport. Not movable.
class Renderer {
public:
    /// @throws InvalidInput for a picture larger than the driver's limit or empty; GlError for a driver that
    /// fails.
    explicit Renderer(const RendererOptions& options = {});
    Renderer(const Renderer&) = delete;
    Renderer& operator=(const Renderer&) = delete;
    ~Renderer();

    /// Sets the size of later pictures. @throws as the constructor
    void resize(int width, int height);

    void set_surroundings(const Surroundings& surroundings);

    /// Draws one frame and what its overlay shows. @pre a barrier for texture fetches, vertices and storage
    /// lies behind what shaders wrote into the buffers: Simulator::render_view has one
    void draw(const RenderView& bodies, const Camera& camera);

    /// high or fast.
    Quality quality() const { return options_.quality; }
    int width() const { return options_.width; }
    int height() const { return options_.height; }

    /// The finished picture: RGBA8, sRGB values; rows from the bottom. For FrameGrabber, or to copy to a
    /// window.
    unsigned framebuffer() const { return pipeline_->picture().framebuffer(); }

private:
    const gl::Buffer<glm::vec4>& colors_of(const RenderView& bodies);
    void aim_shadows(const RenderView& bodies, const View& view);

    RendererOptions options_;
    std::unique_ptr<Pipeline> pipeline_;
    Shadows shadows_;
    Overlay overlay_;
    unsigned vertex_array_ = 0;

    Surroundings surroundings_;  // with y up
    Axis up_ = Axis::y;          // of what is given
    std::optional<TurnedView> turned_view_;
    StaticMesh props_;
    gl::Buffer<glm::vec4> body_colors_;
    gl::Buffer<glm::vec4> object_colors_;  // if the overlay distinguishes objects
    gl::Buffer<glm::vec4> prop_colors_;
};

}  // namespace gelatin::render
