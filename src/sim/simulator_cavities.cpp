// What gas cavities have.
#include <fmt/core.h>

#include "gelatin/error.h"
#include "model/scene/names.h"
#include "model/scene/validate_cavities.h"
#include "sim/simulation.h"

namespace gelatin {

double Simulator::Impl::cavity_drive(std::size_t cavity, double time) const {
    const auto set = cavity_gas.find(cavity);
    return model->cavities[cavity].drive_at(
        time, set != cavity_gas.end() ? std::optional(set->second) : std::nullopt);
}

// As of the end of the step. The watch does not know how much energy they may give.
std::vector<double> Simulation::find_cavity_drives() {
    const double end = clock.time() + clock.step_size();
    std::vector<double> drives;
    for (std::size_t c = 0; c < model->cavities.size(); ++c) drives.push_back(cavity_drive(c, end));
    if (!drives.empty()) watch->note_hand(end);
    return drives;
}

std::vector<CavityStatus> Simulator::Impl::cavity_states() const {
    std::vector<CavityStatus> states;
    for (std::size_t c = 0; c < model->cavities.size(); ++c) {
        const Cavity& cavity = model->cavities[c];
        const double volume = enclosed_volume(std::span(cavity.faces), solver->host_nodes().positions);
        states.push_back(
            {cavity.gas.name, cavity.object, volume, cavity.pressure(cavity_drive(c, clock.time()), volume)});
    }
    return states;
}

const Cavity& Simulation::require_cavity(std::size_t cavity) const {
    if (cavity >= model->cavities.size())
        throw InvalidInput(
            fmt::format("there is no cavity {}: there are {}, from 0", cavity, model->cavities.size()));
    return model->cavities[cavity];
}

std::vector<CavityStatus> Simulator::cavities() const {
    return impl_->cavity_states();
}

std::size_t Simulator::cavity_index(std::string_view object, std::string_view name) const {
    const ModelObject& body = impl_->model->objects[object_index(object)];
    std::vector<std::string> names;
    for (std::uint32_t c = body.cavities.first; c < body.cavities.end(); ++c) {
        names.push_back(impl_->model->cavities[c].gas.name);
        if (names.back() == name) return c;
    }
    throw InvalidInput(fmt::format("object '{}' has no cavity '{}'{}; {}", object, name,
                                   suggestion(name, names),
                                   names.empty() ? "it has none" : "there is " + join_names(names)));
}

void Simulator::set_cavity(std::size_t cavity, const CavityGas& gas) {
    Simulation& d = impl_->simulation();
    const CavityDescription& description = d.require_cavity(cavity).gas;
    const auto fail = [&](const FieldPath& field, const std::string& value, const std::string& problem) {
        throw InvalidInput({{}, 0, describe(field, description.name), value, problem});
    };
    const ReportProblem report = fail;
    check_gas(ValueChecks(report), FieldPath("cavity", cavity), description, gas);
    d.cavity_gas[cavity] = gas;
}

}  // namespace gelatin
