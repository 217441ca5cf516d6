#pragma once

#include <glm/vec2.hpp>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "cpu/cpu_solver.h"
#include "gelatin/views.h"
#include "gpu/gpu_solver.h"
#include "gpu/view/mark_faces.h"
#include "sim/color_source.h"
#include "sim/contact_overlay.h"
#include "sim/overlay_line.h"

namespace gelatin {

/// Provides a renderer with the data of overlays: from the GPU solver's own buffers, or, if the CPU
/// simulates, uploaded from the host once a frame. Overlays that are not requested cost nothing.
class OverlaySource {
public:
    explicit OverlaySource(std::shared_ptr<const Model> model) : model_(std::move(model)) {}

    /// Updates the solver's boxes if they are requested. Ends with the barriers that drawing needs.
    /// @param bodies what is drawn, with the solver's nodes in its overlay
    OverlayView update(const Overlays& overlays, const RenderView& bodies, gpu::GpuSolver& solver);
    OverlayView update(const Overlays& overlays, const RenderView& bodies, cpu::CpuSolver<float>& solver);
    /// Adds lines.
    void view_lines(std::span<const OverlayLine> lines, OverlayView& view);

private:
    OverlayView update(const Overlays& overlays, const RenderView& bodies, unsigned boxes,
                       unsigned velocities, Solver& solver);
    void view_boxes(const Overlays& overlays, OverlayView& view);
    void view_objects(OverlayView& view);
    void view_springs(float full_strain, OverlayView& view);
    void view_cut(const CutPlane& cut, OverlayView& view);
    void view_colors(const ColorMap& map, unsigned velocities, OverlayView& view);
    void view_arrows(float time, unsigned velocities, OverlayView& view);
    void view_contacts(const Overlays& overlays, Solver& solver, OverlayView& view);
    void make_marks();

    std::shared_ptr<const Model> model_;
    gl::Buffer<glm::uvec2> shown_boxes_;
    std::optional<int> shown_levels_;  // of shown_boxes_
    bool shown_alone_ = false;
    gl::Buffer<std::uint32_t> roots_;
    std::vector<std::string> names_;
    gl::Buffer<Box> uploaded_boxes_;
    gl::Buffer<std::uint32_t> marks_;  // by face
    std::optional<gpu::MarkFaces> mark_faces_;
    gl::Buffer<Spring> springs_;
    gl::Buffer<glm::uvec4> tets_;
    gl::Buffer<std::uint32_t> tet_objects_;
    std::optional<ColorSource> colors_;
    std::optional<ContactOverlay> contacts_;
    gl::Buffer<std::uint32_t> arrow_nodes_;
    gl::Buffer<glm::vec4> uploaded_velocities_;
    gl::Buffer<OverlayLine> lines_;
};

}  // namespace gelatin
