#pragma once

#include <array>
#include <functional>
#include <vector>

#include "gelatin/scene.h"

namespace gelatin::test {

/// A thick sphere of a neo-Hookean material that stays one: the radii of its layers where it is in balance.
struct RadialSphere {
    double inner, outer;  ///< radii at rest [m]
    Material material;

    /// Under a pressure inside [Pa], as a function of the volume there [m^3]: by Newton's method on the
    /// energy of 200 layers that are linear across. @return the radii of both surfaces [m]
    std::array<double, 2> balance(const std::function<double(double)>& pressure) const;

    /// By Lame, for small strains: of the inner radius, for a pressure [m].
    double small_growth(double pressure) const;
    /// The mass that moves as fast as the inner radius where all of it moves in proportion to that growth
    /// [kg].
    double moving_mass() const;
};

}  // namespace gelatin::test
