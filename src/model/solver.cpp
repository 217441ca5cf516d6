#include "model/solver.h"

#include <glm/geometric.hpp>

namespace gelatin {

double resting_speed(const glm::vec3& gravity, double step) {
    return 2.0 * step * static_cast<double>(glm::length(gravity));
}

}  // namespace gelatin
