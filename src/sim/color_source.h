#pragma once

#include "gelatin/views.h"
#include "gl/readback.h"
#include "gpu/view/tet_values.h"
#include "sim/value_range.h"

namespace gelatin {

/// Gives a renderer a quantity at tets and nodes, found on the GPU, with the range that colours show of it. A
/// range that nobody has set follows the values a picture later, which spares a wait; the first picture
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
    float end_ = 0.0f;  // of the range, above the least value; 0: not known yet
    gl::Readback readback_;
};

}  // namespace gelatin
