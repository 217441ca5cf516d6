#include "sim/energy_budget.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace gelatin {
namespace {

constexpr double kSlack = 10.0;

// Of springs at twice their length, and of volumes that are gone.
double energy_out_of_shape(const Model& model) {
    double sum = 0.0;
    for (const TetRest& tet : model.tet_rests)
        sum += 0.5 * static_cast<double>(std::abs(tet.lacking)) * static_cast<double>(tet.volume);
    for (const Spring& spring : model.springs) {
        const auto length = static_cast<double>(spring.rest_length);
        sum += 0.5 * static_cast<double>(spring.stiffness) * length * length;
    }
    return sum;
}

double moving_mass(const Model& model) {
    double sum = 0.0;
    for (std::uint32_t n = 0; n < model.node_count(); ++n)
        sum += model.positions[n].w > 0.0f ? static_cast<double>(model.masses[n]) : 0.0;
    return sum;
}

}  // namespace

EnergyBudget::EnergyBudget(const Model& model, const Account& start)
    : allowance_(energy_out_of_shape(model)),
      drive_(static_cast<double>(glm::length(model.gravity)) * std::sqrt(0.5 * moving_mass(model))),
      start_(start),
      latest_(start) {}

double EnergyBudget::most_at(double time) const {
    const double root = std::sqrt(latest_.energy + allowance_) + drive_ * (time - latest_.time);
    return kSlack * root * root;
}

double EnergyBudget::most_for(const Account& now) const {
    const double given = std::max(0.0, start_.potential - now.potential);
    return kSlack * (start_.energy + given + allowance_);
}

}  // namespace gelatin
