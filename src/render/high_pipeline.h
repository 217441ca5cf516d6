#pragma once

#include "render/ambient_occlusion.h"
#include "render/pipeline.h"
#include "render/pixel_light.h"
#include "render/scenery.h"

namespace gelatin::render {

/// How edges become smooth: by several samples a pixel, or by a filter over the finished picture, which is
/// cheaper on software drivers. automatic: the filter on software drivers, samples on all others.
enum class Smoothing { automatic, samples, filter, none };

/// Light at each pixel, ambient occlusion, smooth edges.
class HighPipeline : public Pipeline {
public:
    HighPipeline(int width, int height, Smoothing smoothing);

    void draw(const Frame& frame) override;
    void resize(int width, int height) override;
    const Target& picture() const override { return picture_; }

private:
    void smooth_edges() const;

    Smoothing smoothing_;
    AmbientOcclusion occlusion_;
    Scenery scenery_{occlusion_};
    PixelLight light_{&occlusion_};
    gl::Program filter_program_;
    Target canvas_;   // what is drawn into, edges not smoothed yet
    Target picture_;  // what comes out
};

}  // namespace gelatin::render
