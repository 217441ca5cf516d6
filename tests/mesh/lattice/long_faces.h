#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>

#include "mesh/surface_mesh.h"

namespace gelatin {

/// A disc of thickness 0.2 and radius 0.5 whose two sides are fans of `count` faces around their centres,
/// tilted against all axes: long thin faces, as CAD programs make them.
inline SurfaceMesh make_fan_disc(std::uint32_t count) {
    SurfaceMesh disc;
    const glm::dvec3 u(0.8, 0.6, 0.0), v(-0.36, 0.48, 0.8), w(0.48, -0.64, 0.6);
    for (const double height : {-0.1, 0.1}) {
        disc.positions.push_back(height * w);
        for (std::uint32_t k = 0; k < count; ++k) {
            const double angle = 2.0 * std::numbers::pi * k / count;
            disc.positions.push_back(height * w + 0.5 * (std::cos(angle) * u + std::sin(angle) * v));
        }
    }
    const std::uint32_t top = count + 1;
    for (std::uint32_t k = 0; k < count; ++k) {
        const std::uint32_t a = 1 + k, b = 1 + (k + 1) % count;
        disc.faces.emplace_back(0, b, a);
        disc.faces.emplace_back(top, top + a, top + b);
        disc.faces.emplace_back(a, b, top + b);
        disc.faces.emplace_back(a, top + b, top + a);
    }
    return disc;
}

}  // namespace gelatin
