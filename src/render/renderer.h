#pragma once

#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <optional>
#include <vector>

#include "gelatin/views.h"
#include "gl/buffer.h"
#include "gl/program.h"
#include "mesh/surface_mesh.h"
#include "render/camera.h"
#include "render/shadows.h"
#include "render/static_mesh.h"
#include "render/target.h"

namespace gelatin::render {

/// Where the light of bodies is worked out: at each pixel, or at each node as in the paper (faster, less
/// smooth).
enum class Shading { pixel, node };

/// How edges become smooth: by several samples a pixel, or by a filter over the finished picture, which is
/// cheaper on software drivers. automatic: the filter on software drivers, samples on all others.
enum class Smoothing { automatic, samples, filter, none };

struct RendererOptions {
    int width = 1280;  ///< [pixels], >= 1
    int height = 720;  ///< [pixels], >= 1
    Shading shading = Shading::pixel;
    Smoothing smoothing = Smoothing::automatic;
    int shadow_resolution = 1024;  ///< of the key light's map [pixels a side]
};

/// What stays the same from frame to frame.
struct Surroundings {
    Bounds bounds;  ///< of the bodies at the start: sets the scale of floor and shadows [m]
    std::optional<float> floor_height;  ///< [m]; empty: no floor is drawn
    std::vector<SurfaceMesh> props;     ///< what stands about and does not move
    /// Of the bodies, linear RGB; the palette's where one is negative or missing.
    std::vector<glm::vec3> colors;
};

/// Draws bodies from their buffers into a picture of its own: floor, backdrop, soft shadows.
///
/// Needs the context that it was made in and that the buffers belong to. Changes the state of OpenGL, but for
/// the framebuffer and the viewport. Not movable.
class Renderer {
public:
    /// @throws InvalidInput for a picture larger than the driver's limit or empty; GlError for a driver that
    /// fails.
    explicit Renderer(const RendererOptions& options = {});
    Renderer(const Renderer&) = delete;
    Renderer& operator=(const Renderer&) = delete;
    ~Renderer();

    void set_surroundings(const Surroundings& surroundings);

    /// Draws one frame. Orders itself after the dispatches that wrote the buffers; does not wait for them.
    void draw(const RenderView& bodies, const Camera& camera);

    int width() const { return options_.width; }
    int height() const { return options_.height; }

    /// The finished picture: RGBA8, sRGB values; rows from the bottom. For FrameGrabber, or to copy to a
    /// window.
    unsigned framebuffer() const { return picture_.framebuffer(); }

private:
    void draw_scene(const SurfaceDraw& bodies, const SurfaceDraw& props, const Camera& camera) const;
    void set_frame_uniforms(const gl::Program& program, const Camera& camera) const;
    void grow_colors(std::uint32_t body_count);
    void aim_shadows(const RenderView& bodies);
    void smooth_edges() const;
    void draw_floor(const Camera& camera) const;

    RendererOptions options_;
    gl::Program surface_program_;
    gl::Program floor_program_;
    gl::Program backdrop_program_;
    gl::Program filter_program_;
    Target canvas_;   // what is drawn into, edges not smoothed yet
    Target picture_;  // what comes out
    Shadows shadows_;
    unsigned vertex_array_ = 0;

    Surroundings surroundings_;
    StaticMesh props_;
    gl::Buffer<glm::vec4> body_colors_;
    gl::Buffer<glm::vec4> prop_colors_;
};

}  // namespace gelatin::render
