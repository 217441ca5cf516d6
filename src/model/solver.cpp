#include "model/solver.h"

#include <glm/geometric.hpp>

namespace gelatin {

double resting_speed(const glm::vec3& gravity, double step) {
    return 2.0 * step * static_cast<double>(glm::length(gravity));
}

double chebyshev_weight(double spectral_radius, int sweep) {
    double weight = sweep < 2 ? 1.0 : 2.0 / (2.0 - spectral_radius * spectral_radius);
    for (int k = 2; k < sweep; ++k) weight = 4.0 / (4.0 - spectral_radius * spectral_radius * weight);
    return weight;
}

}  // namespace gelatin
