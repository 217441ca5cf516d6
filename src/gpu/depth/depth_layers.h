#pragma once

#include "gl/program.h"

namespace gelatin::gpu {

/// Pictures of what is nearest along a direction of sight: the depth of the nearest surface and the object
/// that it belongs to, and the depth of the nearest surface of any other object.
class DepthLayers {
public:
    /// @param resolution [pixels a side]
    /// @throws GlError if the driver cannot draw into them.
    explicit DepthLayers(int resolution);
    DepthLayers(const DepthLayers&) = delete;
    DepthLayers& operator=(const DepthLayers&) = delete;
    ~DepthLayers();

    /// Draws go into the emptied pictures of the nearest surface from now on.
    /// @pre the masks let them be written; the same for the others
    void begin_nearest() const;
    /// Draws go into the emptied picture of the nearest other surface.
    void begin_nearest_other() const;
    /// Draws go nowhere: only what fragments store by themselves stays.
    void begin_comparison() const;

    void bind_nearest_object(const gl::Program& program) const;
    /// Nearest depth, nearest object and nearest other depth.
    void bind_all(const gl::Program& program) const;

private:
    enum Picture : unsigned { nearest_depth, nearest_object, nearest_other_depth, picture_count };
    enum Pass : unsigned { nearest, nearest_other, comparison, pass_count };

    DepthLayers() = default;
    void make_textures(int resolution);
    void make_framebuffers(int resolution);

    unsigned textures_[picture_count] = {};
    unsigned framebuffers_[pass_count] = {};
};

}  // namespace gelatin::gpu
