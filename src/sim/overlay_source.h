#pragma once

#include <glm/vec2.hpp>
#include <memory>
#include <optional>

#include "cpu/cpu_solver.h"
#include "gelatin/views.h"
#include "gpu/gpu_solver.h"
#include "gpu/mark_faces.h"

namespace gelatin {

/// Gives a renderer what overlays show: from the GPU solver's own buffers, or uploaded from the host once a
/// frame where the CPU simulates. What is not asked for costs nothing.
class OverlaySource {
public:
    explicit OverlaySource(std::shared_ptr<const Model> model) : model_(std::move(model)) {}

    /// Brings the solver's boxes up to date where they are asked for. Ends with the barriers that drawing
    /// needs.
    OverlayView update(const Overlays& overlays, gpu::GpuSolver& solver);
    OverlayView update(const Overlays& overlays, cpu::CpuSolver<float>& solver);

private:
    void view_boxes(int levels, unsigned boxes, OverlayView& view);
    void view_marks(OverlayView& view) const { view.face_marks = marks_.id(); }
    void view_springs(float full_strain, OverlayView& view);
    void make_marks();

    std::shared_ptr<const Model> model_;
    gl::Buffer<glm::uvec2> shown_boxes_;
    int shown_levels_ = -1;  // of shown_boxes_
    gl::Buffer<Box> uploaded_boxes_;
    gl::Buffer<std::uint32_t> marks_;  // by face
    std::optional<gpu::MarkFaces> mark_faces_;
    gl::Buffer<Spring> springs_;
};

}  // namespace gelatin
