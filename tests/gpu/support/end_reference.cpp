#include "gpu/support/end_reference.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numeric>
#include <utility>

#include "cpu/contact/tuning.h"
#include "support/converted.h"

namespace gelatin::test {
namespace tuning = cpu::tuning;

EndReference::EndReference(std::shared_ptr<const Model> some_model, double some_restitution, bool contacts)
    : model(std::move(some_model)),
      surface(std::make_shared<ContactSurface>(
          make_contact_surface(*model, CollisionSettings{.restitution = some_restitution}))),
      from{converted<double>(model->positions), converted<double>(model->velocities)},
      to(from),
      system(model),
      rows(model, surface),
      scheme(model),
      energy(model),
      paces(model),
      restitution(model, surface),
      guard(model, surface),
      contacts_(contacts),
      pairs_(model, surface, contacts),
      object_of_(model->node_objects),
      asleep_(model->body_count()),
      expected_(model->node_count()),
      ends_(model->node_count()),
      compliances_(model->node_count()) {}

glm::dvec3 EndReference::acceleration(std::size_t n) const {
    const glm::dvec3 gravity(model->gravity);
    return loads.empty() ? gravity : gravity + from.positions[n].w * glm::dvec3(loads[n]);
}

void EndReference::find_rows() {
    const double h = step_size, least = std::max(h, tuning::kFrame);
    for (std::size_t n = 0; n < expected_.size(); ++n) {
        const double w = from.positions[n].w;
        expected_[n] = h * glm::dvec3(from.velocities[n]);
        if (w > 0.0) expected_[n] += h * h * acceleration(n);
        ends_[n] = from.positions[n] + glm::dvec4(expected_[n], 0.0);
        compliances_[n] =
            w > 0.0 ? 1.0 / (1.0 / (w * least * least) + static_cast<double>(surface->stiffness[n]) / 3.0)
                    : 0.0;
    }
    if (contacts_) {
        const cpu::Paths<double> paths{
            .from = from.positions, .to = ends_, .velocities = from.velocities, .step = h};
        pairs_.begin(paths, true, asleep_);
        pairs_.run(paths);
    }
    std::span<const cpu::NearPair<double>> near = pairs_.pairs();
    if (is_apart) near = {};
    rows.make({from.positions, expected_, compliances_, h, scheme.last_step()}, near,
              cpu::AttachmentRows<double>(model), system.rows);
    system.rows.insert(system.rows.end(), own_rows.begin(), own_rows.end());
}

void EndReference::linearise() {
    std::vector<glm::dvec4> velocities = from.velocities;
    for (std::size_t n = 0; n < velocities.size(); ++n)
        velocities[n].w = std::max(velocities[n].w, scheme.of(object_of_[n]).damping);
    system.elastic.linearise(from.positions, velocities, 1.0 / step_size);
    for (std::size_t n = 0; n < expected_.size(); ++n) {
        const double w = from.positions[n].w, h = scheme.of(object_of_[n]).step;
        system.inertia[n] = w > 0.0 ? 1.0 / (w * h * h) : 0.0;
        system.displacements[n] = w > 0.0 ? scheme.target(from, n, acceleration(n)) : expected_[n];
    }
    if (pulls != nullptr)
        for (const std::uint32_t n : pulls->nodes()) {
            if (system.inertia[n] == 0.0) continue;
            const glm::dvec3 x(from.positions[n]);
            const glm::dvec4 both = pulls->with_target(
                n, glm::dvec4(x + system.displacements[n], system.inertia[n]), x, step_size);
            system.displacements[n] = glm::dvec3(both) - x;
            system.inertia[n] = both.w;
        }
    system.rigid.begin(from.positions, system.inertia);
    system.loads = system.elastic.forces();
    system.rigid.follow_rotation(from.positions, system.inertia, system.displacements, system.loads);
    for (std::size_t n = 0; n < expected_.size(); ++n)
        system.loads[n] += system.inertia[n] * system.displacements[n];
}

void EndReference::begin() {
    scheme.begin(from);
    energy.begin(from);
}

void EndReference::solve(double step, bool damps) {
    step_size = step;
    find_rows();
    islands.find<double>(*model, system.rows, from, !loads.empty() || pulls != nullptr);
    has_past = paces.choose(islands, step, damps, system.rows, scheme);
    linearise();
    system.iterations = 40;
    std::fill(system.enough.begin(), system.enough.end(), 0.0);
    system.solve(islands.of_bodies);
}

void EndReference::finish() {
    Field forces(expected_.size(), glm::dvec3(0.0));
    for (std::size_t n = 0; n < loads.size(); ++n) forces[n] = glm::dvec3(loads[n]);
    for (const cpu::ContactRow<double>& row : system.rows) {
        if (row.object == row.other) continue;
        const glm::dvec3 force = row.force(cpu::relative<double>(row, system.displacements));
        for (std::uint32_t k = 0; k < row.count; ++k) forces[row.nodes[k]] += row.weights[k] * force;
    }
    if (pulls != nullptr)
        for (const std::uint32_t n : pulls->nodes()) {
            const glm::dvec4 x = from.positions[n];
            forces[n] += pulls->force_at_end(n, x + glm::dvec4(system.displacements[n], 0.0), glm::dvec3(x),
                                             step_size);
        }
    rows.note(system.rows, system.displacements, asleep_);
    system.rigid.rotate(from.positions, system.inertia, system.displacements);
    to = from;
    for (std::size_t n = 0; n < expected_.size(); ++n) {
        const glm::dvec3& d = system.displacements[n];
        to.positions[n] += glm::dvec4(d, 0.0);
        if (from.positions[n].w > 0.0)
            to.velocities[n] = glm::dvec4(scheme.velocity(from, n, d), from.velocities[n].w);
    }
    std::vector<std::uint32_t> each(islands.of_bodies.size());
    std::iota(each.begin(), each.end(), 0u);
    scheme.keep_momenta(system.rigid, each, forces, to);
}

double EndReference::measure() {
    return energy.measure(
        {step_size, loads, pulls, on_held_, system.rows, system.displacements, islands, asleep_, from, to});
}

// Once: what strays from paths is not found.
void EndReference::run_guard() {
    const std::vector<glm::dvec4> wanted = to.positions;
    std::vector<std::uint8_t> is_blocked;
    guard.run({from.positions, ends_}, pairs_.pairs(), compliances_, to.positions, is_blocked);
    is_guarded = !contacts_ && guard.has_changed();
    for (std::size_t n = 0; n < wanted.size(); ++n) {
        if (to.positions[n] == wanted[n]) continue;
        is_guarded = true;
        if (contacts_) to.positions[n] = glm::dvec4(glm::vec3(to.positions[n]), wanted[n].w);
        guarded[n] = to.positions[n];
    }
}

// As cpu::ImplicitStep does.
std::vector<std::uint32_t> EndReference::stop_guarded() {
    std::vector<cpu::RigidSums> sums(model->body_count());  // by island
    std::vector<std::uint8_t> is_stopped(sums.size());
    for (std::uint32_t n = 0; n < model->body_node_count(); ++n) {
        if (to.positions[n].w == 0.0) continue;
        const glm::dvec3 wanted = glm::dvec3(from.positions[n]) + system.displacements[n];
        const glm::dvec3 change = (glm::dvec3(to.positions[n]) - wanted) / step_size;
        to.velocities[n] += glm::dvec4(change, 0.0);
        const double mass = 1.0 / to.positions[n].w;
        const std::uint32_t island = islands.of_bodies[object_of_[n]];
        sums[island].add(glm::dvec3(to.positions[n]), mass, mass * change);
        if (change != glm::dvec3(0.0)) is_stopped[island] = 1;
    }
    std::vector<std::uint32_t> stopped;
    for (std::uint32_t o = 0; o < model->body_count(); ++o) {
        const std::uint32_t island = islands.of_bodies[o];
        if (is_stopped[island] == 0) continue;
        stopped.push_back(o);
        if (islands.are_held[island] != 0) continue;
        const cpu::RigidInertia inertia(sums[island]);
        const cpu::Twist lost = inertia.twist(sums[island].force, sums[island].moment);
        const Range& nodes = model->objects[o].nodes;
        for (std::uint32_t n = nodes.first; n < nodes.end(); ++n)
            to.velocities[n] -= glm::dvec4(lost.at(glm::dvec3(to.positions[n]) - inertia.center), 0.0);
    }
    return stopped;
}

EndReference::Outcome EndReference::end(double shortest) {
    const bool is_shortest = step_size < 2.0 * shortest;
    finish();
    paces.find(system, asleep_, to);
    on_held_ = system.elastic_forces();
    gained = measure();
    is_guarded = false;
    guarded.assign(to.positions.size(), glm::dvec4(-1.0));
    if (has_past && gained > 0.0) return Outcome::damped;
    run_guard();
    std::vector<std::uint32_t> stopped;
    if (is_guarded) {
        gained = measure();
        if (gained > 0.0) {
            stopped = stop_guarded();
            gained = measure();
        }
    }
    if (!is_shortest && gained > tuning::kSlightly) return Outcome::divided;
    const bool stands_still = !std::isfinite(gained);
    if (stands_still) {
        to = from;
        energy.forget();
        std::fill(paces.struck().begin(), paces.struck().end(), std::uint8_t(1));
        for (glm::dvec4& v : to.velocities)
            if (to.positions[static_cast<std::size_t>(&v - to.velocities.data())].w != 0.0)
                v = glm::dvec4(0.0, 0.0, 0.0, v.w);
        scheme.end(from, to);
    } else {
        energy.settle(islands, to);
        rows.remember();
        scheme.end(from, to);
        const double gravity = glm::length(glm::dvec3(model->gravity));
        if (restitution.run({step_size, 2.0 * tuning::kFrame * gravity, system.rows, system.displacements,
                             from, energy.before(), energy.after()},
                            system.rigid, to)) {
            energy.change();
            has_bounced = true;
        }
        std::fill(paces.struck().begin(), paces.struck().end(), std::uint8_t(0));
        for (const std::uint32_t o : stopped) paces.struck()[o] = 1;
    }
    from = to;
    return stands_still ? Outcome::stood_still : Outcome::made;
}

}  // namespace gelatin::test
