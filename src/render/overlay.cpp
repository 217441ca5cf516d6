#include "render/overlay.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <string>

namespace gelatin::render {
namespace {

constexpr float kHiddenBoxes = 0.28f;  // opacity of what lies behind something
constexpr float kHiddenFaces = 0.6f;
constexpr float kUsualHeight = 720.0f;  // of a picture [pixels], whose lines are as wide as they are told

// Lines of larger pictures are wider.
void set_line(const gl::Program& program, const View& view, float width, float opacity) {
    program.set("line_width", width * std::max(1.0f, static_cast<float>(view.height) / kUsualHeight));
    program.set("opacity", opacity);
}

void draw_vertices(std::size_t count) {
    glDrawArrays(GL_TRIANGLES, 0, static_cast<GLsizei>(count));
}

}  // namespace

void Overlay::show(const RenderView& bodies) {
    const OverlayView& view = bodies.overlay;
    boxes_.reset();
    faces_.reset();
    springs_.reset();
    if (view.boxes != 0) {
        boxes_ = Boxes{{view.boxes, std::size_t{32} * view.box_count, gl::TexelFormat::rgba32f},
                       {view.shown_boxes, std::size_t{8} * view.shown_box_count, gl::TexelFormat::rg32ui},
                       view.shown_box_count};
        if (!box_program_) box_program_ = gl::Program::graphics("render/box_lines.vert", "render/line.frag");
    }
    if (view.face_marks != 0) {
        faces_ = Faces{{view.face_marks, std::size_t{4} * bodies.face_count, gl::TexelFormat::r32ui}};
        if (!face_program_)
            face_program_ = gl::Program::graphics("render/face_marks.vert", "render/face_marks.frag");
    }
    if (view.springs != 0) {
        springs_ =
            Springs{{bodies.node_positions, std::size_t{16} * bodies.node_count, gl::TexelFormat::rgba32f},
                    {view.springs, std::size_t{16} * view.spring_count, gl::TexelFormat::rgba32ui},
                    view.spring_count,
                    view.full_strain};
        if (!spring_program_) {
            spring_program_ = gl::Program::graphics("render/spring_lines.vert", "render/line.frag");
            glass_program_ = gl::Program::graphics("render/surface.vert", "render/glass.frag");
        }
        if (!legend_ || legend_->full_strain() != view.full_strain) legend_.emplace(view.full_strain);
    }
}

void Overlay::draw(const Frame& frame) const {
    if (is_empty()) return;
    glEnable(GL_DEPTH_TEST);
    glEnable(GL_BLEND);
    glBlendEquation(GL_FUNC_ADD);
    glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
    glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_FALSE);  // alpha is what smooth_edges.frag goes by
    glDepthMask(GL_FALSE);
    if (springs_) draw_springs(frame);
    glDisable(GL_CULL_FACE);
    if (faces_) draw_faces(frame);
    if (boxes_) draw_boxes(frame.view);
    glDisable(GL_DEPTH_TEST);
    if (springs_) legend_->draw(frame.view);
    glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    glDepthMask(GL_TRUE);
    glEnable(GL_CULL_FACE);
    glDisable(GL_BLEND);
}

// Hidden lines are fainter, not gone: all of them faintly, then over that what is in front.
void Overlay::draw_boxes(const View& view) const {
    boxes_->boxes.bind(0);
    boxes_->shown.bind(1);
    view.set_uniforms(*box_program_);
    box_program_->use();
    for (const bool in_front : {false, true}) {
        (in_front ? glEnable : glDisable)(GL_DEPTH_TEST);
        set_line(*box_program_, view, 1.5f, in_front ? 1.0f : kHiddenBoxes);
        draw_vertices(std::size_t{72} * boxes_->count);
    }
}

// Faces that touch lie between bodies: they shine through what hides them.
void Overlay::draw_faces(const Frame& frame) const {
    frame.bodies.surfaces.bind_textures();
    frame.bodies.surfaces.bind_triangles(3);
    faces_->marks.bind(6);
    frame.view.set_uniforms(*face_program_);
    face_program_->use();
    glEnable(GL_POLYGON_OFFSET_FILL);  // over the bodies' own, drawn by another program
    glPolygonOffset(-1.0f, -4.0f);
    for (const bool in_front : {false, true}) {
        (in_front ? glEnable : glDisable)(GL_DEPTH_TEST);
        face_program_->set("opacity", in_front ? 1.0f : kHiddenFaces);
        draw_vertices(std::size_t{3} * frame.bodies.surfaces.face_count());
    }
    glDisable(GL_POLYGON_OFFSET_FILL);
}

// Bodies of glass first, whose springs then are seen as if through nothing.
void Overlay::draw_springs(const Frame& frame) const {
    frame.view.set_uniforms(*glass_program_);
    glass_program_->use();
    frame.bodies.colors.bind(3);
    frame.bodies.surfaces.draw();

    glDisable(GL_CULL_FACE);
    springs_->positions.bind(0);
    springs_->springs.bind(1);
    const auto& colors = strain_colors();
    for (std::size_t i = 0; i < colors.size(); ++i)
        spring_program_->set(("strain_colors[" + std::to_string(i) + "]").c_str(), colors[i]);
    spring_program_->set("full_strain", springs_->full_strain);
    frame.view.set_uniforms(*spring_program_);
    set_line(*spring_program_, frame.view, 1.2f, 1.0f);
    spring_program_->use();
    draw_vertices(std::size_t{6} * springs_->count);
}

}  // namespace gelatin::render
