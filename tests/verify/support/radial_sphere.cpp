#include "verify/support/radial_sphere.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "model/elasticity/neo_hookean.h"

namespace gelatin::test {
namespace {

constexpr std::size_t kLayers = 200;
constexpr double kSphere = 4.0 / 3.0 * std::numbers::pi;

using Radii = std::vector<double>;

// The derivative of the energy by radii, at rest and now; of the volume term, too, which here is a sum by
// layer.
Radii gradient(const NeoHookeanModuli& moduli, const Radii& rest, const Radii& now,
               const std::function<double(double)>& pressure) {
    Radii result(now.size(), 0.0);
    for (std::size_t l = 0; l < kLayers; ++l) {
        const double thickness = rest[l + 1] - rest[l], middle = 0.5 * (rest[l] + rest[l + 1]);
        const double volume = kSphere * (std::pow(rest[l + 1], 3) - std::pow(rest[l], 3));
        const double across = (now[l + 1] - now[l]) / thickness, along = 0.5 * (now[l] + now[l + 1]) / middle;
        const double squares = across * across + 2.0 * along * along, ratio = across * along * along;
        const double shear = moduli.mu * squares / (squares + 1.0),
                     hydrostatic = (moduli.lambda + moduli.kappa) * (ratio - 1.0) - 0.75 * moduli.mu;
        const double by_across = volume * (shear * across + hydrostatic * along * along) / thickness,
                     by_along = volume * (shear * along + hydrostatic * across * along) / middle;
        result[l] += by_along - by_across;
        result[l + 1] += by_along + by_across;
    }
    result[0] -= pressure(kSphere * std::pow(now[0], 3)) * 3.0 * kSphere * now[0] * now[0];
    return result;
}

// Each radius acts on itself and its neighbours: differences by every third one have all of the matrix.
Radii newton_step(const std::function<Radii(const Radii&)>& f, const Radii& at) {
    constexpr double kDifference = 1e-7;
    const std::size_t n = at.size();
    std::vector<std::array<double, 3>> rows(n);  // before, own, after
    for (std::size_t first = 0; first < 3; ++first) {
        Radii ahead = at, back = at;
        for (std::size_t k = first; k < n; k += 3) {
            ahead[k] += kDifference;
            back[k] -= kDifference;
        }
        const Radii up = f(ahead), down = f(back);
        for (std::size_t k = first; k < n; k += 3)
            for (std::size_t r = k == 0 ? 0 : k - 1; r <= std::min(k + 1, n - 1); ++r)
                rows[r][k + 1 - r] = (up[r] - down[r]) / (2.0 * kDifference);
    }
    Radii step = f(at);
    for (std::size_t r = 1; r < n; ++r) {
        const double factor = rows[r][0] / rows[r - 1][1];
        rows[r][1] -= factor * rows[r - 1][2];
        step[r] -= factor * step[r - 1];
    }
    for (std::size_t r = n; r-- > 0;)
        step[r] = (step[r] - (r + 1 < n ? rows[r][2] * step[r + 1] : 0.0)) / rows[r][1];
    return step;
}

}  // namespace

std::array<double, 2> RadialSphere::balance(const std::function<double(double)>& pressure) const {
    const NeoHookeanModuli moduli = neo_hookean_moduli(material.youngs_modulus, material.poisson_ratio);
    Radii rest;
    for (std::size_t l = 0; l <= kLayers; ++l)
        rest.push_back(std::lerp(inner, outer, static_cast<double>(l) / kLayers));
    Radii now = rest;
    constexpr int kStages = 8, kRounds = 20;
    for (int stage = 1; stage <= kStages; ++stage) {
        const auto f = [&](const Radii& at) {
            return gradient(moduli, rest, at, [&](double v) { return pressure(v) * stage / kStages; });
        };
        for (int k = 0; k < kRounds; ++k) {
            const Radii step = newton_step(f, now);
            for (std::size_t r = 0; r < now.size(); ++r) now[r] -= step[r];
        }
    }
    return {now.front(), now.back()};
}

// u = p a^3 / (E (b^3 - a^3)) ((1 - 2 nu) r + (1 + nu) b^3 / (2 r^2)).
double RadialSphere::small_growth(double pressure) const {
    const double a = std::pow(inner, 3), b = std::pow(outer, 3), nu = material.poisson_ratio;
    return pressure * a / (material.youngs_modulus * (b - a)) *
           ((1.0 - 2.0 * nu) * inner + (1.0 + nu) * b / (2.0 * inner * inner));
}

double RadialSphere::moving_mass() const {
    const double b = std::pow(outer, 3), nu = material.poisson_ratio;
    const auto shape = [&](double r) { return (1.0 - 2.0 * nu) * r + (1.0 + nu) * b / (2.0 * r * r); };
    double sum = 0.0;
    for (std::size_t l = 0; l < kLayers; ++l) {
        const double r = std::lerp(inner, outer, (static_cast<double>(l) + 0.5) / kLayers);
        sum += std::pow(shape(r) / shape(inner) * r, 2) * (outer - inner) / kLayers;
    }
    return 3.0 * kSphere * material.density * sum;
}

}  // namespace gelatin::test
