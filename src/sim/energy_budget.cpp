#include "sim/energy_budget.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "cpu/elasticity/neo_hookean.h"

namespace gelatin {
namespace {

constexpr double kSlack = 10.0;

// Of springs and tets at twice their length, and of volumes compressed to zero.
double energy_out_of_shape(const Model& model) {
    double sum = 0.0;
    for (const TetRest& tet : model.tet_rests)
        sum += 0.5 * static_cast<double>(std::abs(tet.kappa)) * static_cast<double>(tet.volume);
    for (const NeoHookeanTet& tet : model.neo_hookean_tets)
        sum += cpu::neo_hookean_energy(cpu::Mat3<double>(2.0), cpu::tet_moduli<double>(tet));
    for (const Spring& spring : model.springs) {
        const auto length = static_cast<double>(spring.rest_length);
        sum += 0.5 * static_cast<double>(spring.stiffness) * length * length;
    }
    return sum;
}

// Of rigid bodies that move by their size in a sixtieth of a second: as contact may push them apart.
double energy_of_pushed(const Model& model) {
    constexpr double kRate = 60.0;
    double sum = 0.0;
    for (const ModelObject& body : model.bodies())
        if (body.is_rigid) sum += 0.5 * body.mass * std::pow(kRate * std::cbrt(body.rest_volume), 2);
    return sum;
}

// The largest force of all loads together on each node [N].
double most_load(const Model& model, const LoadedNode& loaded) {
    constexpr double kGrowth = 4.0;  // of a face
    const glm::dvec3 position(model.positions[loaded.node]);
    double sum = 0.0;
    for (std::uint32_t e = loaded.first; e < loaded.end; ++e) {
        const NodeLoad& load = model.loads.entries[e];
        const double twice_area = glm::length(glm::cross(glm::dvec3(model.positions[load.b]) - position,
                                                         glm::dvec3(model.positions[load.c]) - position));
        sum += glm::length(glm::dvec3(load.force)) +
               kGrowth * std::abs(static_cast<double>(load.force.w)) * twice_area;
    }
    return sum;
}

std::vector<double> free_inverse_masses(const Model& model) {
    std::vector<double> all;
    for (const ModelObject& object : model.objects) {
        const std::vector<double> own = free_inverse_masses(model, object);
        all.insert(all.end(), own.begin(), own.end());
    }
    return all;
}

double drive_of_gravity(const Model& model) {
    double mass = 0.0;
    for (const double inverse_mass : free_inverse_masses(model))
        mass += inverse_mass > 0.0 ? 1.0 / inverse_mass : 0.0;
    return static_cast<double>(glm::length(model.gravity)) * std::sqrt(0.5 * mass);
}

double drive_of_loads(const Model& model) {
    const std::vector<double> inverse_masses = free_inverse_masses(model);
    double sum = 0.0;
    for (const LoadedNode& loaded : model.loads.nodes)
        sum += std::pow(most_load(model, loaded), 2) * inverse_masses[loaded.node];
    return std::sqrt(0.5 * sum);
}

}  // namespace

EnergyBudget::EnergyBudget(const Model& model, const Account& start)
    : allowance_(energy_out_of_shape(model) + energy_of_pushed(model)),
      gravity_drive_(drive_of_gravity(model)),
      load_drive_(drive_of_loads(model)),
      start_(start),
      latest_(start) {}

double EnergyBudget::root_at(double time) const {
    const double since = time - latest_.time;
    return std::sqrt(latest_.energy + allowance_) + (gravity_drive_ + load_drive_) * since;
}

// sqrt(E) only grows in the bound, so the power is largest at the end.
double EnergyBudget::work_of_loads(double time) const {
    return given_by_loads_ + 2.0 * load_drive_ * root_at(time) * (time - latest_.time);
}

double EnergyBudget::most_at(double time) const {
    return kSlack * root_at(time) * root_at(time);
}

double EnergyBudget::most_for(const Account& now) const {
    const double given = std::max(0.0, start_.potential - now.potential);
    return kSlack * (start_.energy + given + work_of_loads(now.time) + allowance_);
}

void EnergyBudget::note(const Account& now) {
    given_by_loads_ = work_of_loads(now.time);
    latest_ = now;
    // In an impact contacts have what was lost, and give it back.
    const double given = std::max(0.0, start_.potential - now.potential);
    latest_.energy = std::max(now.energy, start_.energy + given + given_by_loads_);
}

void EnergyBudget::restart(const Account& start) {
    given_by_loads_ = 0.0;
    start_ = latest_ = start;
}

}  // namespace gelatin
