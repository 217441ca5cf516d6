#pragma once

#include <glm/vec4.hpp>
#include <memory>
#include <span>

#include "gelatin/views.h"
#include "gl/readback.h"
#include "gpu/gpu_solver.h"
#include "gpu/view/update_normals.h"

namespace gelatin {

/// Provides a renderer with nodes and up-to-date normals: from the GPU solver's own buffers, or, if the CPU
/// simulates, uploaded from the host once a frame.
class DrawSource {
public:
    explicit DrawSource(std::shared_ptr<const Model> model);

    RenderView update(const gpu::GpuSolver& solver);
    RenderView update(const State& state);

private:
    void fit_box(std::span<const glm::vec4> positions);
    RenderView view(const gl::Buffer<glm::vec4>& positions) const;

    std::shared_ptr<const Model> model_;
    gpu::UpdateNormals normals_;
    gl::Buffer<glm::vec4> uploaded_;  // xyz [m]; empty if the GPU simulates
    gl::BufferTexture uploaded_texels_;
    gl::Readback readback_;                    // of a GPU's positions, so that the box never needs a wait
    glm::vec3 box_min_{0.0f}, box_max_{0.0f};  // [m]
};

}  // namespace gelatin
