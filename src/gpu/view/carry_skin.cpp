#include "gpu/view/carry_skin.h"

namespace gelatin::gpu {

CarrySkin::CarrySkin(std::span<const SkinPoint> points)
    : program_(gl::Program::compute("sim/view/carry_skin.comp")), points_(points) {
    program_.bind("SkinPoints", points_);
}

void CarrySkin::run(const gl::BufferTexture& position_texels, const gl::Buffer<glm::vec4>& out) const {
    gl::barrier(gl::Barrier::storage);  // pictures and copies of the state before may still read `out`
    program_.bind("positions", position_texels);
    program_.bind("PointPositions", out);
    program_.set("point_count", static_cast<std::uint32_t>(points_.size()));
    program_.dispatch(points_.size());
    gl::barrier(gl::Barrier::texture_fetch);
}

}  // namespace gelatin::gpu
