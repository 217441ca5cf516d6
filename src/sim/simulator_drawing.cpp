// What a renderer draws, and the context in which it does.
#include "core/stage.h"
#include "gelatin/error.h"
#include "gl/object_name.h"
#include "sim/attachment_lines.h"
#include "sim/backend.h"
#include "sim/bone_lines.h"
#include "sim/simulator_impl.h"

namespace gelatin {

std::vector<OverlayLine> Simulator::Impl::overlay_lines(const Overlays& overlays) {
    const std::vector<glm::vec4> positions = solver->read_state().positions;
    std::vector<OverlayLine> lines;
    if (overlays.attachments) lines = attachment_lines(made_attachments().all, *model, positions);
    if (!overlays.bones) return lines;
    for (std::size_t h = 0; h < model->handles.size(); ++h) {
        if (!is_held(model->handles[h], time_of(h), clock.step_size())) continue;
        const std::vector<OverlayLine> bones = bone_lines(*model, h, pose_of(h), time_of(h), positions);
        lines.insert(lines.end(), bones.begin(), bones.end());
    }
    return lines;
}

RenderView Simulator::render_view(const Overlays& overlays) {
    gl::forget_state();  // the application may have used OpenGL since
    Impl& d = *impl_;
    if (!d.context)
        throw NoOpenGl("drawing needs an OpenGL context: request it with SimulatorOptions::need_gl");
    const auto host = d.keep_host_state();
    if (!d.draw_source) d.draw_source.emplace(d.model);
    RenderView view = d.solver.visit([&](auto& solver) { return d.draw_source->update(solver, overlays); });
    if (!overlays.any()) return view;
    if (!d.overlay_source) d.overlay_source.emplace(d.model);
    const Stage stage(d.solver->stage_timer(), "update_overlays");
    view.overlay =
        d.solver.visit([&](auto& solver) { return d.overlay_source->update(overlays, view, solver); });
    if (overlays.attachments || overlays.bones)
        d.overlay_source->view_lines(d.overlay_lines(overlays), view.overlay);
    return view;
}

std::unique_ptr<gl::HostState> SimulatorInternals::keep_host_state(const Simulator& simulator) {
    return simulator.impl_->keep_host_state();
}

void SimulatorInternals::make_current(Simulator& simulator) {
    if (simulator.impl_->context) simulator.impl_->context->make_current();
}

void SimulatorInternals::need_context(Simulator& simulator) {
    Impl& d = *simulator.impl_;
    if (d.context) return;
    SimulatorOptions options = d.options;
    options.need_gl = true;
    d.context = make_context(options);
}

}  // namespace gelatin
