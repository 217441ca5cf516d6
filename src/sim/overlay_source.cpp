#include "sim/overlay_source.h"

#include <vector>

namespace gelatin {
namespace {

// The nodes of trees down to a number of levels below their roots: index, level.
std::vector<glm::uvec2> list_boxes(const BoxTree& trees, int levels) {
    std::vector<glm::uvec2> list;
    std::vector<std::uint32_t> ends;  // of the subtrees that the node lies in
    for (std::uint32_t n = 0; n < trees.nodes.size(); ++n) {
        while (!ends.empty() && ends.back() <= n) ends.pop_back();
        if (ends.size() <= static_cast<std::size_t>(levels)) list.emplace_back(n, ends.size());
        ends.push_back(trees.nodes[n].skip);
    }
    return list;
}

}  // namespace

OverlayView OverlaySource::update(const Overlays& overlays, gpu::GpuSolver& solver) {
    OverlayView view;
    if (overlays.box_levels) {
        solver.update_boxes();
        view_boxes(*overlays.box_levels, solver.collision().buffers.face_trees.boxes.id(), view);
    }
    if (overlays.faces) {
        make_marks();
        if (!mark_faces_) mark_faces_.emplace(*model_);
        if (solver.has_collision()) {
            const auto& self = solver.collision().self;
            mark_faces_->run(solver.model_buffers(), solver.collision().buffers,
                             self ? &self->buffers : nullptr, marks_);
        }
        view_marks(view);
    }
    if (overlays.full_strain) view_springs(*overlays.full_strain, view);
    return view;
}

OverlayView OverlaySource::update(const Overlays& overlays, cpu::CpuSolver<float>& solver) {
    OverlayView view;
    if (overlays.box_levels) {
        solver.update_boxes();
        std::vector<Box> boxes;
        for (const cpu::AxisBox<float>& box : solver.collision().tree_boxes())
            boxes.push_back({glm::vec4(box.min, 0.0f), glm::vec4(box.max, 0.0f)});
        if (uploaded_boxes_.empty()) uploaded_boxes_ = gl::Buffer<Box>(boxes.size());
        uploaded_boxes_.upload(boxes);
        view_boxes(*overlays.box_levels, uploaded_boxes_.id(), view);
    }
    if (overlays.faces) {
        std::vector<std::uint32_t> marks(model_->faces.size());
        for (std::uint32_t f = 0; f < marks.size(); ++f) marks[f] = solver.collides(f) ? 1 : 0;
        make_marks();
        marks_.upload(marks);
        view_marks(view);
    }
    if (overlays.full_strain) view_springs(*overlays.full_strain, view);
    return view;
}

void OverlaySource::view_boxes(int levels, unsigned boxes, OverlayView& view) {
    if (shown_levels_ != levels) {
        shown_boxes_ =
            gl::Buffer<glm::uvec2>(std::span<const glm::uvec2>(list_boxes(model_->face_trees, levels)));
        shown_levels_ = levels;
    }
    view.boxes = boxes;
    view.box_count = static_cast<std::uint32_t>(model_->face_trees.nodes.size());
    view.shown_boxes = shown_boxes_.id();
    view.shown_box_count = static_cast<std::uint32_t>(shown_boxes_.size());
}

// Where nothing can collide they stay so.
void OverlaySource::make_marks() {
    if (!marks_.empty()) return;
    marks_ = gl::Buffer<std::uint32_t>(model_->faces.size());
    marks_.fill(0);
}

void OverlaySource::view_springs(float full_strain, OverlayView& view) {
    if (springs_.empty()) springs_ = gl::Buffer<Spring>(std::span(model_->springs));
    view.springs = springs_.id();
    view.spring_count = static_cast<std::uint32_t>(springs_.size());
    view.full_strain = full_strain;
}

}  // namespace gelatin
