#include "render/overlay.h"

#include <epoxy/gl.h>

namespace gelatin::render {
namespace {

template <class Part>
Part& made(std::optional<Part>& part) {
    return part ? *part : part.emplace();
}

}  // namespace

void Overlay::show(const RenderView& bodies, int letter_size) {
    bodies_ = bodies;
    const OverlayView& shown = bodies.overlay;
    const bool has_solids = !has_springs();
    if ((shown.color_map || shown.cut) && has_solids) made(recolored_).prepare(shown);
    if (shown.cut && has_solids) made(cut_).find(bodies);
    if (has_springs()) made(springs_);
    if (shown.face_marks != 0 || shown.wireframe) made(faces_).prepare(shown);
    if (shown.shown_boxes != 0) made(boxes_);
    if (shown.arrows || shown.contact_forces) made(arrows_);
    if (shown.lines != 0) made(lines_);
    if (shown.objects) made(labels_).show(*shown.objects, letter_size);
    if (has_springs()) {
        made(legend_).show(strain_scale(shown.full_strain), letter_size);
    } else if (shown.color_map) {
        made(legend_).show(value_scale(*shown.color_map), letter_size);
    }
}

bool Overlay::is_empty() const {
    const OverlayView& shown = view();
    return !replaces_bodies() && shown.face_marks == 0 && shown.shown_boxes == 0 && !shown.wireframe &&
           !shown.arrows && !shown.contact_forces && !shown.objects && shown.lines == 0;
}

void Overlay::draw_bodies(const Frame& frame) const {
    if (has_springs()) return;
    recolored_->draw(frame, bodies_);
    if (view().cut) cut_->draw(frame, bodies_);
}

void Overlay::draw(const Frame& frame) const {
    if (is_empty()) return;
    const OverlayView& shown = view();
    glEnable(GL_DEPTH_TEST);
    glEnable(GL_BLEND);
    glBlendEquation(GL_FUNC_ADD);
    glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
    glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_FALSE);  // smooth_edges.frag reads alpha
    glDepthMask(GL_FALSE);
    glDisable(GL_CULL_FACE);
    if (has_springs()) springs_->draw(frame, bodies_);
    if (shows_pressures()) recolored_->draw_pressed(frame, bodies_);
    if (shown.wireframe) faces_->draw_edges(frame);
    if (shown.face_marks != 0) faces_->draw_marks(frame, shown);
    if (shown.shown_boxes != 0) boxes_->draw(frame.view, shown);
    if (shown.arrows) arrows_->draw_velocities(frame, bodies_);
    if (shown.contact_forces) arrows_->draw_forces(frame, bodies_);
    if (shown.lines != 0) lines_->draw(frame, shown);
    glDisable(GL_DEPTH_TEST);
    if (shown.objects) labels_->draw(frame.view, shown);
    if (has_springs() || shown.color_map) legend_->draw(frame.view);
    glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    glDepthMask(GL_TRUE);
    glEnable(GL_CULL_FACE);
    glDisable(GL_BLEND);
}

}  // namespace gelatin::render
