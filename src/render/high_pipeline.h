#pragma once

#include "render/ambient_occlusion.h"
#include "render/pipeline.h"
#include "render/pixel_light.h"
#include "render/scenery.h"

namespace gelatin::render {

/// How edges are smoothed: by multisampling, or by a filter over the finished picture, which is cheaper on
/// software drivers. automatic: the filter on software drivers, multisampling on all others.
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
    Target canvas_;   // target before edges are smoothed
    Target picture_;  // the finished picture
};

}  // namespace gelatin::render
