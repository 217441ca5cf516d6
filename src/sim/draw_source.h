#pragma once

#include <glm/vec4.hpp>
#include <memory>
#include <optional>
#include <span>

#include "cpu/cpu_solver.h"
#include "gelatin/views.h"
#include "gl/readback.h"
#include "gpu/gpu_solver.h"
#include "gpu/view/carry_skin.h"
#include "gpu/view/update_normals.h"
#include "sim/skin_textures.h"

namespace gelatin {

/// Provides a renderer with what is drawn of the bodies, and up-to-date normals: from the GPU solver's own
/// buffers, or, if the CPU simulates, uploaded from the host once a frame. That is the skin; the boundary of
/// the tets where there is none, or where overlays show values of nodes, or mark faces.
class DrawSource {
public:
    explicit DrawSource(std::shared_ptr<const Model> model);

    /// The view's overlay has the nodes, and nothing else.
    RenderView update(gpu::GpuSolver& solver, const Overlays& overlays);
    RenderView update(const cpu::CpuSolver<float>& solver, const Overlays& overlays);

private:
    /// Positions of this class' own: xyz [m].
    struct Positions {
        gl::Buffer<glm::vec4> buffer;
        gl::BufferTexture texels;
        void make(std::size_t count);
    };
    bool draws_skin(const Overlays& overlays) const;
    gpu::UpdateNormals& normals(bool of_skin);
    void fit_box(std::span<const glm::vec4> positions);
    RenderView view(bool of_skin, const gl::Buffer<glm::vec4>& positions);

    std::shared_ptr<const Model> model_;
    // Made when they are first needed.
    std::optional<gpu::UpdateNormals> hull_normals_, skin_normals_;
    std::optional<gpu::CarrySkin> carry_skin_;
    std::optional<SkinTextures> textures_;
    Positions nodes_;                          // empty if the GPU simulates
    Positions points_;                         // of the skin
    gl::Readback readback_;                    // of a GPU's positions, so that the box never needs a wait
    glm::vec3 box_min_{0.0f}, box_max_{0.0f};  // [m]
};

}  // namespace gelatin
