#include <algorithm>
#include <utility>

#include "sim/forces.h"
#include "sim/simulator_impl.h"

namespace gelatin {

void Simulator::begin_statistics() {
    gl::forget_state();  // the application may have used OpenGL since
    Impl& d = *impl_;
    const auto host = d.keep_host_state_of_solver();
    d.run_stage("measure", [&] { d.solver->begin_measure(); });
    d.measured.push_back(d.now());
    if (d.has_contact_forces())
        d.measured_forces.push_back(gelatin::contact_forces(d.scene, *d.model, *d.solver));
    d.measured_holds.push_back(holding_forces(*d.model, *d.solver));
}

std::size_t Simulator::pending_statistics() const {
    return impl_->measured.size();
}

FrameStatistics Simulator::take_statistics() {
    Impl& d = *impl_;
    if (d.measured.empty()) throw InvalidInput("take_statistics: begin_statistics was not called before");
    const auto host = d.keep_host_state_of_solver();
    const std::vector<ObjectMeasure> objects = d.solver->end_measure();
    const Moment moment = d.measured.front();
    d.measured.pop_front();
    d.watch->check(d.solver->alarm(false), moment, d.now());
    d.watch->check(objects, moment);
    FrameStatistics frame;
    frame.frame = moment.frame;
    frame.time = moment.time;
    d.warn_of_lost_pairs();
    if (d.seeks_proximities()) frame.proximities = d.take_proximities();
    if (d.has_contact_forces()) {
        frame.contact_forces = std::move(d.measured_forces.front());
        d.measured_forces.pop_front();
    }
    frame.holding_forces = std::move(d.measured_holds.front());
    d.measured_holds.pop_front();
    for (std::size_t o = 0; o < objects.size(); ++o) {
        const ObjectMeasure& object = objects[o];
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
    return frame;
}

std::vector<std::pair<std::string, std::vector<double>>> Simulator::take_stage_times() {
    const auto host = impl_->keep_host_state_of_solver();
    const StageTimes times = impl_->solver->stage_timer().take();
    return {times.begin(), times.end()};
}

HostFrame Simulator::read_frame() const {
    const auto kept = impl_->keep_host_state_of_solver();
    const State state = impl_->solver->read_state();
    HostFrame host;
    host.frame = frame();
    host.time = time();
    for (const glm::vec4& p : state.positions) host.positions.insert(host.positions.end(), {p.x, p.y, p.z});
    for (const glm::vec4& v : state.velocities)
        host.velocities.insert(host.velocities.end(), {v.x, v.y, v.z});
    for (const glm::dvec3& force : impl_->solver->holding_forces().nodes)
        for (int k = 0; k < 3; ++k) host.holding_forces.push_back(static_cast<float>(force[k]));
    if (!impl_->has_contact_forces()) return host;
    const ContactForces forces = impl_->solver->contact_forces();
    for (std::size_t n = 0; n < forces.normal.size(); ++n) {
        const glm::vec3 friction(forces.friction[n]), force(forces.normal[n] + forces.friction[n]);
        host.contact_forces.insert(host.contact_forces.end(), {force.x, force.y, force.z});
        host.contact_friction.insert(host.contact_friction.end(), {friction.x, friction.y, friction.z});
    }
    return host;
}

}  // namespace gelatin
