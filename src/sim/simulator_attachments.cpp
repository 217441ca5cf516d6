// What objects are attached to, and how hard.
#include <fmt/core.h>

#include <utility>

#include "core/log.h"
#include "gelatin/error.h"
#include "model/assembly/attachments.h"
#include "sim/simulation.h"

namespace gelatin {

std::vector<AttachmentStatus> Simulator::Impl::attachment_states() const {
    const std::vector<AttachmentForce> found = solver->attachment_forces();
    std::vector<AttachmentStatus> states;
    for (std::size_t a = 0; a < found.size(); ++a) {
        const AttachmentDescription& description = scene.attachments[a];
        AttachmentStatus state{name_of_attachment(description, a), {}, found[a].is_broken};
        for (int k = 0; k < 3; ++k) state.force[k] = found[a].force[k];
        if (found[a].has_coordinate)
            state.joint = JointStatus{found[a].coordinate, found[a].speed, found[a].effort};
        states.push_back(std::move(state));
    }
    return states;
}

void Simulation::require_attachment(std::size_t attachment) const {
    if (attachment >= attachments.size())
        throw InvalidInput(
            fmt::format("there is no attachment {}: there are {}, from 0", attachment, attachments.size()));
}

void Simulation::set_attachments() {
    if (!attachments.empty() || !solver->attachment_forces().empty()) solver->set_attachments(attachments);
}

void Simulation::look_for_broken() {
    const std::vector<AttachmentForce> found = solver->attachment_forces();
    for (std::size_t a = 0; a < found.size(); ++a) {
        if (!found[a].is_broken || std::exchange(attachments[a].is_broken, true)) continue;
        log_note(fmt::format("{} broke at {:.4g} s, by {:.4g} N", attachments[a].name, clock.time(),
                             glm::length(found[a].force)));
    }
}

std::vector<AttachmentStatus> Simulator::attachments() const {
    return impl_->attachment_states();
}

std::size_t Simulator::attach(const AttachmentDescription& attachment) {
    Simulation& d = impl_->simulation();
    Scene next = d.scene;
    next.attachments.push_back(attachment);
    validate(next);
    const auto host = d.keep_host_state_of_solver();
    Attachment made =
        make_attachment(attachment, d.attachments.size(), next, *d.model, d.solver->read_state().positions);
    const bool needs_host = d.attachments.empty() && d.solver.uses_gl();
    d.attachments.push_back(std::move(made));
    d.scene.attachments.push_back(attachment);
    if (needs_host) {
        d.rebuild(d.scene, d.unpinned, d.pins);
    } else {
        d.set_attachments();
    }
    return d.attachments.size() - 1;
}

void Simulator::set_motor(std::size_t attachment, const JointMotor& motor) {
    Simulation& d = impl_->simulation();
    d.require_attachment(attachment);
    Scene next = d.scene;
    next.attachments[attachment].motor = motor;
    validate(next);
    d.motors[attachment] = motor;
}

void Simulator::detach(std::size_t attachment) {
    Simulation& d = impl_->simulation();
    d.require_attachment(attachment);
    const auto host = d.keep_host_state_of_solver();
    d.attachments[attachment].is_broken = true;
    d.set_attachments();
}

}  // namespace gelatin
