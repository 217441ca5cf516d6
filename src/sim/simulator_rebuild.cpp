// What programs change between steps that the solver's tables depend on.
#include <fmt/core.h>

#include <algorithm>
#include <utility>

#include "gelatin/error.h"
#include "model/assembly/build_model.h"
#include "model/explicit/stability.h"
#include "model/scene/names.h"
#include "sim/carry_over.h"
#include "sim/simulation.h"

namespace gelatin {
namespace {

bool is_pin_of(const Model& model, const HandleNode& held, const AddedPin& pin) {
    const Handle& handle = model.handles[held.handle];
    return handle.is_pin && handle.object == pin.object && handle.count == pin.nodes.size() &&
           held.node == pin.nodes.front();
}

// Where a pin that is new has its nodes they are already.
void rest_new_pins(const Model& model, const std::vector<AddedPin>& added, std::size_t known, Drags& drags) {
    std::vector<Drag> places = drags.drags(), targets = drags.targets();
    for (std::size_t p = known; p < added.size(); ++p) {
        for (const HandleNode& held : model.handle_nodes) {
            if (!is_pin_of(model, held, added[p])) continue;
            places[held.handle] = targets[held.handle] = {};
        }
    }
    drags.go_on_with(std::move(places), std::move(targets));
}

// Masses and dampings are the model's; where somebody starts deformed, and how fast, stays.
void take_constants(const Model& model, State& state) {
    for (std::size_t n = 0; n < state.positions.size(); ++n) {
        state.positions[n].w = model.positions[n].w;
        state.velocities[n].w = model.velocities[n].w;
    }
}

}  // namespace

void Simulation::carry_over_to(const Model& next, const std::vector<AddedPin>& added, State& state,
                               Drags& next_drags, HandleClocks& next_clocks) const {
    state = carried_over(*model, solver->read_state(), next, {next.positions, next.velocities, {}});
    next_clocks.go_on_with(carried_over(*model, handle_clocks.delays(), next));
    next_drags = carried_over(*model, drags, next, state, next_clocks.times(clock.time()), next_drags);
    const std::size_t known = std::min(pins.size(), added.size());
    rest_new_pins(next, added, known, next_drags);
}

// Whatever throws does so before anything has changed.
void Simulation::rebuild(const Scene& of, std::shared_ptr<const Model> from, std::vector<AddedPin> added) {
    auto next = added.empty() ? from : std::make_shared<const Model>(with_pins(*from, added));
    const int next_substeps = choose_substeps(of, *next);
    BackendSolver next_solver = make_solver(of, next);
    Drags next_drags(next);
    HandleClocks next_clocks(next);
    State state;
    carry_over_to(*next, added, state, next_drags, next_clocks);
    if (start_state) take_constants(*from, *start_state);
    const Moment moment = clock.now();

    draw_source.reset();
    overlay_source.reset();
    discard_pending();
    scene = of;
    model = next;
    unpinned = std::move(from);
    pins = std::move(added);
    clock = RunClock(scene.simulation.frame_time(), next_substeps);
    solver = std::move(next_solver);
    reported_losses = 0;
    watch.emplace(scene, model, next_substeps);
    drags = std::move(next_drags);
    handle_clocks = std::move(next_clocks);
    arms = HandleArms(model, arms.programmed());
    copies = {};
    solver->set_pulls(pulls);
    solver->set_forces(forces);
    set_attachments();
    take_state(state, moment);
}

void Simulator::pin(std::size_t object, std::span<const std::uint32_t> nodes) {
    Simulation& d = impl_->simulation();
    const ModelObject& body = d.body(object);
    if (body.is_rigid)
        throw InvalidInput(
            fmt::format("object '{}' is rigid: not pins, but an attachment holds it", body.name));
    if (nodes.empty()) throw InvalidInput(fmt::format("a pin of object '{}' has no nodes", body.name));
    AddedPin pin;
    pin.object = object;
    std::vector<std::uint8_t> is_held(body.nodes.count);
    for (const HandleNode& held : d.model->handle_nodes) {
        if (held.node >= body.nodes.first && held.node < body.nodes.end())
            is_held[held.node - body.nodes.first] = 1;
    }
    const auto host = d.keep_host_state_of_solver();
    const State state = d.solver->read_state();
    for (const std::uint32_t n : nodes) {
        if (n >= body.nodes.count) {
            throw InvalidInput(
                fmt::format("object '{}' has no node {}: it has {}, from 0", body.name, n, body.nodes.count));
        }
        if (is_held[n] != 0) {
            throw InvalidInput(
                fmt::format("node {} of object '{}' is held already, or there twice", n, body.name));
        }
        is_held[n] = 1;
        pin.nodes.push_back(body.nodes.first + n);
        pin.places.emplace_back(state.positions[pin.nodes.back()]);
    }
    std::vector<AddedPin> all = d.pins;
    all.push_back(std::move(pin));
    d.rebuild(d.scene, d.unpinned, std::move(all));
}

void Simulator::unpin(std::size_t object) {
    Simulation& d = impl_->simulation();
    d.body(object);
    std::vector<AddedPin> rest = d.pins;
    const auto gone = std::erase_if(rest, [&](const AddedPin& pin) { return pin.object == object; });
    if (gone == 0) return;
    const auto host = d.keep_host_state_of_solver();
    d.rebuild(d.scene, d.unpinned, std::move(rest));
}

void Simulator::set_material(const Material& material) {
    Simulation& d = impl_->simulation();
    Scene next = d.scene;
    next.meshes = d.model->meshes;
    std::vector<std::string> names;
    for (const Material& each : next.materials) names.push_back(each.name);
    const auto found = std::find_if(next.materials.begin(), next.materials.end(),
                                    [&](const Material& each) { return each.name == material.name; });
    if (found == next.materials.end()) {
        throw InvalidInput(fmt::format("there is no material '{}'{}; there are {}", material.name,
                                       suggestion(material.name, names), join_names(names)));
    }
    if (found->model != material.model || found->springs != material.springs) {
        throw InvalidInput(fmt::format(
            "material '{}': model and springs cannot change between steps: make another simulator",
            material.name));
    }
    *found = material;
    const auto host = d.keep_host_state_of_solver();
    d.rebuild(next, std::make_shared<const Model>(build_model(next)), d.pins);
}

}  // namespace gelatin
