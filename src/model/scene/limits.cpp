#include "model/scene/limits.h"

#include <fmt/format.h>

#include <cmath>

namespace gelatin {

std::optional<std::string> problem_of(double value, const Limit& limit) {
    if (!std::isfinite(value)) return "must be finite";
    if (!limit.holds(value)) return fmt::format("must be {}", limit.allowed);
    // A coordinate may be the rounding of a 0: squares that vanish do no harm there.
    const bool is_coordinate = limit.holds == kAnyNumber.holds;
    const bool is_too_small = !is_coordinate && value != 0.0 && std::abs(value) < 1e-15;
    if (is_too_small || std::abs(value) > 1e15) return "must be 0 or of a magnitude from 1e-15 to 1e15";
    return {};
}

std::string three_numbers_each(const char* points) {
    return fmt::format("{} must be three finite numbers each", points);
}

}  // namespace gelatin
