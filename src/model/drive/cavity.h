#pragma once

#include <cstdint>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <vector>

#include "gelatin/scene.h"

namespace gelatin {

/// Gas in a hollow of a body.
struct Cavity {
    CavityDescription gas;          ///< with a name
    std::uint32_t object = 0;       ///< a body
    std::vector<glm::uvec3> faces;  ///< of the hollow: nodes, counter-clockwise as seen from the body's tets
    double rest_volume = 0.0;       ///< V_0 [m^3], > 0

    /// The pressure of a constant law [Pa], or the amount of a sealed gas, at a time [s].
    /// @param set in place of the keyframes
    double drive_at(double time, const std::optional<CavityGas>& set) const;

    /// With such a drive, at a volume V [m^3]. A sealed gas has the absolute pressure N / V, with what stays,
    /// N = amount (ambient + pressure) V_0.
    double pressure(double drive, double volume) const;   ///< p, above the ambient one [Pa]
    double stiffness(double drive, double volume) const;  ///< -dp/dV [Pa/m^3], >= 0
    /// What p = -dE/dV is the derivative of: of the gas and of what is outside [J].
    double energy(double drive, double volume) const;

private:
    double sealed(double drive) const;  // N [J]
};

/// The volume that faces enclose, by the divergence theorem: a sixth of the sum of a . (b x c), from a point
/// near them [m^3]. @param positions of all nodes
template <class Position>
double enclosed_volume(std::span<const glm::uvec3> faces, std::span<const Position> positions) {
    const glm::dvec3 origin(positions[faces.front().x]);
    const auto at = [&](std::uint32_t n) { return glm::dvec3(positions[n]) - origin; };
    double sum = 0.0;
    for (const glm::uvec3& f : faces) sum += glm::dot(at(f.x), glm::cross(at(f.y), at(f.z)));
    return sum / 6.0;
}

}  // namespace gelatin
