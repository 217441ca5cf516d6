#include "sim/draw_source.h"

#include <cstring>
#include <glm/common.hpp>

namespace gelatin {

DrawSource::DrawSource(std::shared_ptr<const Model> model) : model_(std::move(model)), normals_(*model_) {
    fit_box(model_->positions);
}

RenderView DrawSource::update(const gpu::GpuSolver& solver) {
    const gpu::NodeBuffers& nodes = solver.nodes();
    normals_.run(nodes.position_texels);
    readback_.begin(nodes.positions.id(), nodes.positions.size() * sizeof(glm::vec4));
    if (readback_.pending() > 1) {
        const std::vector<std::byte> bytes = readback_.take();
        std::vector<glm::vec4> positions(bytes.size() / sizeof(glm::vec4));
        std::memcpy(positions.data(), bytes.data(), bytes.size());
        fit_box(positions);
    }
    RenderView late = view(nodes.positions);
    late.box_is_late = true;
    return late;
}

RenderView DrawSource::update(const State& state) {
    if (uploaded_.empty()) {
        uploaded_ = gl::Buffer<glm::vec4>(state.positions.size());
        uploaded_texels_ = gl::BufferTexture(uploaded_, gl::TexelFormat::rgba32f);
    }
    uploaded_.upload(state.positions);
    normals_.run(uploaded_texels_);
    fit_box(state.positions);
    return view(uploaded_);
}

void DrawSource::fit_box(std::span<const glm::vec4> positions) {
    if (positions.empty()) return;
    box_min_ = box_max_ = glm::vec3(positions.front());
    for (const glm::vec4& p : positions) {
        box_min_ = glm::min(box_min_, glm::vec3(p));
        box_max_ = glm::max(box_max_, glm::vec3(p));
    }
}

RenderView DrawSource::view(const gl::Buffer<glm::vec4>& positions) const {
    RenderView view = normals_.view(positions);
    for (int k = 0; k < 3; ++k) {
        view.box_min[k] = box_min_[k];
        view.box_max[k] = box_max_[k];
    }
    return view;
}

}  // namespace gelatin
