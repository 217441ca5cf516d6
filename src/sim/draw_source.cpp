#include "sim/draw_source.h"

#include <cstring>
#include <glm/common.hpp>

#include "core/stage.h"

namespace gelatin {
namespace {

// Their values belong to nodes, their marks to faces between nodes.
bool show_hull(const Overlays& overlays) {
    return overlays.color_map || overlays.faces;
}

void set_nodes(unsigned positions, std::size_t count, RenderView& view) {
    view.overlay.node_positions = positions;
    view.overlay.node_count = static_cast<std::uint32_t>(count);
}

}  // namespace

DrawSource::DrawSource(std::shared_ptr<const Model> model) : model_(std::move(model)) {
    fit_box(model_->positions);
}

RenderView DrawSource::update(gpu::GpuSolver& solver, const Overlays& overlays) {
    const Stage stage(solver.stage_timer(), "update_normals");
    const gpu::NodeBuffers& nodes = solver.nodes();
    const gl::Buffer<glm::vec4>* drawn = &nodes.positions;
    const bool of_skin = draws_skin(overlays);
    if (of_skin) {
        if (!carry_skin_) carry_skin_.emplace(model_->skin.points);
        points_.make(model_->skin.points.size());
        carry_skin_->run(nodes.position_texels, points_.buffer);
        drawn = &points_.buffer;
        normals(of_skin).run(points_.texels);
    } else {
        normals(of_skin).run(nodes.position_texels);
    }
    readback_.begin(drawn->id(), drawn->size() * sizeof(glm::vec4));
    if (readback_.pending() > 1) {
        const std::vector<std::byte> bytes = readback_.take();
        std::vector<glm::vec4> positions(bytes.size() / sizeof(glm::vec4));
        std::memcpy(positions.data(), bytes.data(), bytes.size());
        fit_box(positions);
    }
    RenderView late = view(of_skin, *drawn);
    set_nodes(nodes.positions.id(), nodes.positions.size(), late);
    late.box_is_late = true;
    return late;
}

RenderView DrawSource::update(const cpu::CpuSolver<float>& solver, const Overlays& overlays) {
    const std::vector<glm::vec4>& positions = solver.nodes().positions;
    const bool of_skin = draws_skin(overlays);
    const bool needs_nodes = !of_skin || overlays.any();
    if (needs_nodes) {
        nodes_.make(positions.size());
        nodes_.buffer.upload(positions);
    }
    if (of_skin) {
        const std::vector<glm::vec4> points = carry_skin(model_->skin.points, std::span(positions));
        points_.make(points.size());
        points_.buffer.upload(points);
        fit_box(points);
    } else {
        fit_box(positions);
    }
    const Positions& drawn = of_skin ? points_ : nodes_;
    normals(of_skin).run(drawn.texels);
    RenderView now = view(of_skin, drawn.buffer);
    if (needs_nodes) set_nodes(nodes_.buffer.id(), nodes_.buffer.size(), now);
    return now;
}

void DrawSource::Positions::make(std::size_t count) {
    if (!buffer.empty()) return;
    buffer = gl::Buffer<glm::vec4>(count);
    texels = gl::BufferTexture(buffer, gl::TexelFormat::rgba32f);
}

bool DrawSource::draws_skin(const Overlays& overlays) const {
    return !model_->skin.is_empty() && !show_hull(overlays);
}

gpu::UpdateNormals& DrawSource::normals(bool of_skin) {
    const Model& m = *model_;
    std::optional<gpu::UpdateNormals>& stage = of_skin ? skin_normals_ : hull_normals_;
    if (!stage && of_skin) stage.emplace(m.skin.faces, m.skin.surface);
    if (!stage) stage.emplace(m.faces, m.surface);
    return *stage;
}

void DrawSource::fit_box(std::span<const glm::vec4> positions) {
    if (positions.empty()) return;
    box_min_ = box_max_ = glm::vec3(positions.front());
    for (const glm::vec4& p : positions) {
        box_min_ = glm::min(box_min_, glm::vec3(p));
        box_max_ = glm::max(box_max_, glm::vec3(p));
    }
}

RenderView DrawSource::view(bool of_skin, const gl::Buffer<glm::vec4>& positions) {
    RenderView view = normals(of_skin).view(positions);
    if (of_skin && !model_->skin.look.is_empty()) {
        if (!textures_) textures_.emplace(model_->skin);
        textures_->set(view);
    }
    for (int k = 0; k < 3; ++k) {
        view.box_min[k] = box_min_[k];
        view.box_max[k] = box_max_[k];
    }
    return view;
}

}  // namespace gelatin
