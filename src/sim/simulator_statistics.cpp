#include <fmt/core.h>

#include <algorithm>
#include <utility>

#include "core/counted.h"
#include "core/log.h"
#include "core/stage.h"
#include "gelatin/error.h"
#include "sim/forces.h"
#include "sim/simulator_impl.h"

namespace gelatin {

void Simulator::Impl::warn_of_losses(const Measurement& measured) {
    if (measured.lost_pairs != reported_losses) {
        log_warning(
            fmt::format("{} of objects or faces not tested for collision: too many for the GPU's buffers",
                        counted(measured.lost_pairs - reported_losses, "pair")));
        reported_losses = measured.lost_pairs;
    }
    if (measured.proximities && measured.proximities->lost > 0 && !lost_proximities) {
        log_warning(
            fmt::format("{} proximities were not stored: too many for the GPU's buffers; choose a smaller "
                        "proximity_radius",
                        measured.proximities->lost));
        lost_proximities = true;
    }
}

void Simulator::begin_statistics() {
    gl::forget_state();  // the application may have used OpenGL since
    Impl& d = *impl_;
    const auto host = d.keep_host_state_of_solver();
    {
        const Stage stage(d.solver->stage_timer(), "measure");
        d.solver->begin_measure();
    }
    PendingStatistics& pending = d.pending.emplace_back();
    pending.moment = d.clock.now();
    const ContactForces found = d.solver->contact_forces();
    if (!found.normal.empty()) pending.contacts = count_collider_contacts(*d.model, found);
    if (d.has_contact_forces()) pending.contact_forces = gelatin::contact_forces(d.scene, *d.model, found);
    pending.holding_forces = holding_forces(*d.model, *d.solver);
    pending.attachments = d.attachment_states();
    pending.cavities = d.cavity_states();
}

std::size_t Simulator::pending_statistics() const {
    return impl_->pending.size();
}

FrameStatistics Simulator::take_statistics() {
    Impl& d = *impl_;
    if (d.pending.empty()) throw InvalidInput("take_statistics: begin_statistics was not called before");
    const auto host = d.keep_host_state_of_solver();
    const Measurement measured = d.solver->end_measure();
    PendingStatistics begun = std::move(d.pending.front());
    d.pending.pop_front();
    d.watch->check(d.solver->alarm(false), begun.moment, d.clock.now());
    d.watch->check(measured.objects, begun.moment);
    d.warn_of_losses(measured);
    FrameStatistics frame;
    frame.frame = begun.moment.frame;
    frame.time = begun.moment.time;
    frame.contact_forces = std::move(begun.contact_forces);
    frame.holding_forces = std::move(begun.holding_forces);
    frame.attachments = std::move(begun.attachments);
    frame.cavities = std::move(begun.cavities);
    if (const auto& found = measured.proximities)
        frame.proximities = {found->node_face, found->edge_edge, found->lost, found->nearest};
    for (std::size_t o = 0; o < measured.objects.size(); ++o) {
        const ObjectMeasure& object = measured.objects[o];
        frame.kinetic_energy += object.kinetic_energy;
        frame.elastic_energy += object.elastic_energy;
        frame.potential_energy += object.potential_energy;
        for (int k = 0; k < 3; ++k) frame.momentum[k] += object.momentum[k];
        frame.contacts += object.contacts;
        frame.colliding_faces += object.colliding_faces;
        frame.deepest_penetration = std::max(frame.deepest_penetration, object.deepest_penetration);
        if (d.model->is_body(o))
            frame.volume_ratio.push_back(object.volume / d.model->objects[o].rest_volume);
    }
    if (begun.contacts) frame.contacts = *begun.contacts;
    return frame;
}

std::vector<std::pair<std::string, std::vector<double>>> Simulator::take_stage_times() {
    const auto host = impl_->keep_host_state_of_solver();
    const StageTimes times = impl_->solver->stage_timer().take();
    return {times.begin(), times.end()};
}

}  // namespace gelatin
