#pragma once

#include <optional>

#include "render/pipeline.h"
#include "render/pixel_light.h"
#include "render/scenery.h"
#include "render/vertex_light.h"

namespace gelatin::render {

/// Bodies lit at each vertex, for software drivers, which pay for every pixel that they compute.
///
/// The floor and the backdrop are drawn once and then copied, until the camera moves. Shadows darken that
/// copy where there are any. Edges are not smoothed.
class FastPipeline : public Pipeline {
public:
    FastPipeline(int width, int height);

    void draw(const Frame& frame) override;
    void resize(int width, int height) override;
    const Target& picture() const override { return picture_; }

private:
    void draw_plate(const View& view);
    void restore_picture(const Frame& frame);
    void draw_floor_shade(const Frame& frame) const;
    void draw_floor_shadow(const Frame& frame) const;

    Scenery scenery_;
    VertexLight body_light_;
    PixelLight prop_light_;  // props have few vertices, too far apart for shadows
    gl::Program shade_program_;
    gl::Program shadow_program_;
    Target plate_;                    // floor and backdrop, without shadows
    std::optional<View> plate_view_;  // of the plate
    Target floor_shade_;              // factor of the shadows on the floor
    Target picture_;
    PixelRect drawn_, drawn_depth_;  // the part of the picture that may differ from the plate
};

}  // namespace gelatin::render
