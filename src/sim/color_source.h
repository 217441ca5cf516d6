#pragma once

#include "gelatin/views.h"
#include "gl/readback.h"
#include "gpu/view/tet_values.h"
#include "sim/value_range.h"

namespace gelatin {

/// Provides a quantity at tets and nodes for a renderer, computed on the GPU, with the range of its colours.
/// A range that nobody has set follows the values one picture later, which avoids a wait; the first picture
/// waits.
class ColorSource {
public:
    ColorSource(const Model& model, Quantity quantity);

    Quantity quantity() const { return values_.quantity(); }

    /// @param positions xyz [m] @param velocities xyz [m/s], of all nodes as texels
    ColorMapView update(const ColorMap& map, const gl::BufferTexture& positions,
                        const gl::BufferTexture& velocities);

private:
    void follow_values();

    gpu::TetValues values_;
    CalmRange range_;
    float end_ = 0.0f;  // of the range, above the smallest value; 0: unknown
    gl::Readback readback_;
};

}  // namespace gelatin
