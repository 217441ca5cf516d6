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
    if (attachment >= attachments.all.size())
        throw InvalidInput(fmt::format("there is no attachment {}: there are {}, from 0", attachment,
                                       attachments.all.size()));
}

void Simulation::set_attachments(bool had_some) {
    if (!had_some && !attachments.all.empty() && solver.uses_gl()) {
        rebuild(scene, unpinned, pins);  // for steps on the host
    } else if (!attachments.all.empty() || !solver->attachment_forces().empty()) {
        solver->set_attachments(attachments.all);
    }
}

void Simulation::look_for_broken() {
    const std::vector<AttachmentForce> found = solver->attachment_forces();
    for (std::size_t a = 0; a < found.size(); ++a) {
        if (!found[a].is_broken || std::exchange(attachments.all[a].is_broken, true)) continue;
        log_note(fmt::format("{} broke at {:.4g} s, by {:.4g} N", attachments.all[a].name, clock.time(),
                             glm::length(found[a].force)));
    }
}

std::vector<AttachmentStatus> Simulator::attachments() const {
    return impl_->attachment_states();
}

std::size_t Simulator::attach(const AttachmentDescription& attachment) {
    Simulation& d = impl_->simulation();
    const auto host = d.keep_host_state_of_solver();
    const bool had_some = !d.attachments.all.empty();
    d.attachments.add(attachment, d.solver->read_state().positions, d.scene, *d.model);
    d.set_attachments(had_some);
    return d.attachments.all.size() - 1;
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
    d.attachments.all[attachment].is_broken = true;
    d.set_attachments();
}

}  // namespace gelatin
