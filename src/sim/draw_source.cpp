#include "sim/draw_source.h"

namespace gelatin {

RenderView DrawSource::update(const gpu::GpuSolver& solver) {
    normals_.run(solver.nodes().position_texels);
    return normals_.view(solver.nodes().positions);
}

RenderView DrawSource::update(const State& state) {
    if (uploaded_.empty()) {
        uploaded_ = gl::Buffer<glm::vec4>(state.positions.size());
        uploaded_texels_ = gl::BufferTexture(uploaded_, gl::TexelFormat::rgba32f);
    }
    uploaded_.upload(state.positions);
    normals_.run(uploaded_texels_);
    return normals_.view(uploaded_);
}

}  // namespace gelatin
