#include "sim/overlay_source.h"

#include <algorithm>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <utility>

#include "sim/thin_nodes.h"

namespace gelatin {
namespace {

constexpr std::size_t kArrows = 400;

// The nodes of trees down to a number of levels below their roots, or of only that level: index, and level
// below the first one listed.
std::vector<glm::uvec2> list_boxes(const BoxTree& trees, int levels, bool is_alone) {
    const auto last = static_cast<std::size_t>(levels), first = is_alone ? last : std::size_t{0};
    std::vector<glm::uvec2> list;
    std::vector<std::uint32_t> ends;  // of the subtrees that contain the node
    for (std::uint32_t n = 0; n < trees.nodes.size(); ++n) {
        while (!ends.empty() && ends.back() <= n) ends.pop_back();
        if (ends.size() >= first && ends.size() <= last) list.emplace_back(n, ends.size() - first);
        ends.push_back(trees.nodes[n].skip);
    }
    return list;
}

bool needs_boxes(const Overlays& overlays) {
    return overlays.box_levels || overlays.objects;
}

bool shows_pressures(const Overlays& overlays) {
    return overlays.color_map && overlays.color_map->quantity == Quantity::pressure;
}

bool needs_velocities(const Overlays& overlays) {
    return (overlays.color_map && !shows_pressures(overlays)) || overlays.arrow_time;
}

// Of the box round all.
glm::vec3 middle_of(const std::vector<glm::vec4>& positions) {
    glm::vec3 low(positions.empty() ? glm::vec4(0.0f) : positions.front()), high = low;
    for (const glm::vec4& p : positions) {
        low = glm::min(low, glm::vec3(p));
        high = glm::max(high, glm::vec3(p));
    }
    return 0.5f * (low + high);
}

gl::BufferTexture texels_of(unsigned vectors, std::uint32_t node_count) {
    return {vectors, std::size_t{16} * node_count, gl::TexelFormat::rgba32f};
}

}  // namespace

OverlayView OverlaySource::update(const Overlays& overlays, const RenderView& bodies,
                                  gpu::GpuSolver& solver) {
    const unsigned boxes = needs_boxes(overlays) ? solver.update_tree_boxes().id() : 0;
    if (overlays.faces) {
        make_marks();
        if (!mark_faces_) mark_faces_.emplace(*model_);
        if (const gpu::Collision* const found = solver.collision())
            mark_faces_->run(solver.model_buffers(), found->buffers,
                             found->self ? &found->self->buffers : nullptr, marks_);
    }
    return update(overlays, bodies, boxes, solver.nodes().velocities.id(), solver);
}

OverlayView OverlaySource::update(const Overlays& overlays, const RenderView& bodies,
                                  cpu::CpuSolver<float>& solver) {
    if (needs_boxes(overlays)) {
        std::vector<Box> boxes;
        for (const cpu::AxisBox<float>& box : solver.update_tree_boxes())
            boxes.push_back({glm::vec4(box.min, 0.0f), glm::vec4(box.max, 0.0f)});
        if (uploaded_boxes_.empty()) uploaded_boxes_ = gl::Buffer<Box>(boxes.size());
        uploaded_boxes_.upload(boxes);
    }
    if (overlays.faces) {
        std::vector<std::uint32_t> marks(model_->faces.size());
        for (std::uint32_t f = 0; f < marks.size(); ++f) marks[f] = solver.collides(f) ? 1 : 0;
        make_marks();
        marks_.upload(marks);
    }
    if (needs_velocities(overlays)) {
        const std::vector<glm::vec4>& velocities = solver.nodes().velocities;
        if (uploaded_velocities_.empty()) uploaded_velocities_ = gl::Buffer<glm::vec4>(velocities.size());
        uploaded_velocities_.upload(velocities);
    }
    return update(overlays, bodies, uploaded_boxes_.id(), uploaded_velocities_.id(), solver);
}

OverlayView OverlaySource::update(const Overlays& overlays, const RenderView& bodies, unsigned boxes,
                                  unsigned velocities, Solver& solver) {
    OverlayView view;
    view.node_positions = bodies.overlay.node_positions;
    view.node_count = bodies.overlay.node_count;
    if (needs_boxes(overlays)) {
        view.boxes = boxes;
        view.box_count = static_cast<std::uint32_t>(model_->face_trees.nodes.size());
    }
    if (overlays.box_levels) view_boxes(overlays, view);
    if (overlays.objects) view_objects(view);
    if (overlays.faces) view.face_marks = marks_.id();
    if (overlays.full_strain) view_springs(*overlays.full_strain, view);
    if (overlays.color_map && !shows_pressures(overlays)) view_colors(*overlays.color_map, velocities, view);
    if (overlays.cut) view_cut(*overlays.cut, view);
    if (overlays.arrow_time) view_arrows(*overlays.arrow_time, velocities, view);
    if (overlays.contact_forces || shows_pressures(overlays)) view_contacts(overlays, solver, view);
    view.wireframe = overlays.wireframe;
    return view;
}

void OverlaySource::view_boxes(const Overlays& overlays, OverlayView& view) {
    if (shown_levels_ != overlays.box_levels || shown_alone_ != overlays.lowest_boxes_alone) {
        shown_levels_ = overlays.box_levels;
        shown_alone_ = overlays.lowest_boxes_alone;
        shown_boxes_ = gl::Buffer<glm::uvec2>(
            std::span<const glm::uvec2>(list_boxes(model_->face_trees, *shown_levels_, shown_alone_)));
    }
    view.shown_boxes = shown_boxes_.id();
    view.shown_box_count = static_cast<std::uint32_t>(shown_boxes_.size());
}

void OverlaySource::view_objects(OverlayView& view) {
    if (roots_.empty()) {
        roots_ = gl::Buffer<std::uint32_t>(std::span(model_->face_trees.roots));
        for (const ModelObject& object : model_->objects) names_.push_back(object.name);
    }
    view.objects = ObjectView{.roots = roots_.id(), .names = names_};
}

// If nothing can collide they never change.
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

void OverlaySource::view_cut(const CutPlane& cut, OverlayView& view) {
    if (tets_.empty()) {
        tets_ = gl::Buffer<glm::uvec4>(std::span(model_->tets));
        std::vector<std::uint32_t> objects(model_->tets.size());
        for (std::uint32_t o = 0; o < model_->objects.size(); ++o) {
            const Range tets = model_->objects[o].tets;
            std::fill_n(objects.begin() + tets.first, tets.count, o);
        }
        tet_objects_ = gl::Buffer<std::uint32_t>(std::span<const std::uint32_t>(objects));
    }
    const glm::vec3 normal = glm::normalize(glm::vec3(cut.normal[0], cut.normal[1], cut.normal[2]));
    const float offset = cut.offset.value_or(glm::dot(normal, middle_of(model_->positions)));
    view.cut = CutView{.plane = {normal.x, normal.y, normal.z, -offset},
                       .tets = tets_.id(),
                       .tet_objects = tet_objects_.id(),
                       .tet_count = static_cast<std::uint32_t>(tets_.size())};
}

void OverlaySource::view_colors(const ColorMap& map, unsigned velocities, OverlayView& view) {
    if (!colors_ || colors_->quantity() != map.quantity) colors_.emplace(*model_, map.quantity);
    view.color_map = colors_->update(map, texels_of(view.node_positions, view.node_count),
                                     texels_of(velocities, view.node_count));
}

void OverlaySource::view_arrows(float time, unsigned velocities, OverlayView& view) {
    if (arrow_nodes_.empty()) {
        arrow_nodes_ =
            gl::Buffer<std::uint32_t>(std::span<const std::uint32_t>(thin_surface_nodes(*model_, kArrows)));
    }
    view.arrows = ArrowView{.nodes = arrow_nodes_.id(),
                            .vectors = velocities,
                            .count = static_cast<std::uint32_t>(arrow_nodes_.size()),
                            .scale = time};
}

void OverlaySource::view_lines(std::span<const OverlayLine> lines, OverlayView& view) {
    if (lines.empty()) return;
    if (lines_.size() != lines.size()) lines_ = gl::Buffer<OverlayLine>(lines.size());
    lines_.upload(lines);
    view.lines = lines_.id();
    view.line_count = static_cast<std::uint32_t>(lines.size());
}

void OverlaySource::view_contacts(const Overlays& overlays, Solver& solver, OverlayView& view) {
    if (!contacts_) contacts_.emplace(model_);
    contacts_->read(solver);
    if (overlays.contact_forces) view.contact_forces = contacts_->arrows(*overlays.contact_forces);
    if (shows_pressures(overlays)) view.color_map = contacts_->pressures(*overlays.color_map);
}

}  // namespace gelatin
