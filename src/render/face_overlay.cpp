#include "render/face_overlay.h"

#include <epoxy/gl.h>

namespace gelatin::render {
namespace {

constexpr float kHiddenMarks = 0.6f;  // opacity of what lies behind something
constexpr float kEdgeWidth = 0.9f;    // [pixels]

void draw_faces(const Frame& frame, const gl::Program& program) {
    program.draw_arrays(gl::Primitive::triangles, std::size_t{3} * frame.bodies.surfaces.face_count());
}

void prepare_program(const Frame& frame, const gl::Program& program) {
    frame.bodies.surfaces.bind(program);
    frame.bodies.surfaces.bind_triangles(program);
    frame.view.set_uniforms(program);
    program.set("cut_plane", frame.bodies.surfaces.cut_plane());
}

// Over the bodies' own faces, drawn by another program.
class Raised {
public:
    Raised() {
        glEnable(GL_POLYGON_OFFSET_FILL);
        glPolygonOffset(-1.0f, -4.0f);
    }
    Raised(const Raised&) = delete;
    Raised& operator=(const Raised&) = delete;
    ~Raised() { glDisable(GL_POLYGON_OFFSET_FILL); }
};

}  // namespace

void FaceOverlay::prepare(const OverlayView& overlay) {
    if (overlay.face_marks != 0 && !mark_program_)
        mark_program_ =
            gl::Program::graphics("render/face_corners.vert", "render/face_marks.frag", {"MARKED"});
    if (overlay.wireframe && !edge_program_)
        edge_program_ = gl::Program::graphics("render/face_corners.vert", "render/face_edges.frag");
}

// Faces that touch lie between bodies: they shine through what hides them.
void FaceOverlay::draw_marks(const Frame& frame, const OverlayView& overlay) const {
    const gl::BufferTexture marks(overlay.face_marks, std::size_t{4} * frame.bodies.surfaces.face_count(),
                                  gl::TexelFormat::r32ui);
    mark_program_->bind("face_marks", marks);
    prepare_program(frame, *mark_program_);
    const Clipping clipping(frame.bodies.surfaces);
    const Raised raised;
    for (const bool in_front : {false, true}) {
        (in_front ? glEnable : glDisable)(GL_DEPTH_TEST);
        mark_program_->set("opacity", in_front ? 1.0f : kHiddenMarks);
        draw_faces(frame, *mark_program_);
    }
    glEnable(GL_DEPTH_TEST);
}

void FaceOverlay::draw_edges(const Frame& frame) const {
    prepare_program(frame, *edge_program_);
    const Clipping clipping(frame.bodies.surfaces);
    const Raised raised;
    edge_program_->set("line_width", kEdgeWidth * frame.view.line_scale());
    glEnable(GL_CULL_FACE);
    draw_faces(frame, *edge_program_);
    glDisable(GL_CULL_FACE);
}

}  // namespace gelatin::render
