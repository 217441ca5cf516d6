#pragma once

#include <memory>
#include <optional>

#include "gelatin/views.h"
#include "gpu/gpu_solver.h"
#include "gpu/update_normals.h"

namespace gelatin {

/// Gives a renderer the nodes with normals up to date: from the GPU solver's own buffers, or uploaded from the host
/// once a frame where the CPU simulates.
class DrawSource {
public:
    explicit DrawSource(std::shared_ptr<const Model> model) : model_(std::move(model)), normals_(*model_) {}

    RenderView update(const gpu::GpuSolver& solver);
    RenderView update(const State& state);

private:
    std::shared_ptr<const Model> model_;
    gpu::UpdateNormals normals_;
    gl::Buffer<glm::vec4> uploaded_;  // xyz [m]; empty where the GPU simulates
    gl::BufferTexture uploaded_texels_;
};

}  // namespace gelatin
