#pragma once

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <limits>
#include <vector>

namespace gelatin::test {

/// Of values that differ at most by rounding, the worst over its bound.
class StartErrors {
public:
    /// @param scale of what counts as wrong
    void add(double actual, double expected, double scale) {
        const double error = std::abs(actual - expected) / scale;
        worst_ = std::isfinite(error) ? std::max(worst_, error) : kInfinite;
    }
    void add(const glm::dvec3& actual, const glm::dvec3& expected, double scale) {
        add(glm::distance(actual, expected), 0.0, scale);
    }
    /// By the root of the mean square of what is expected.
    void add(const std::vector<glm::dvec3>& actual, const std::vector<glm::dvec3>& expected,
             double tolerance) {
        double squares = 0.0;
        for (const glm::dvec3& value : expected) squares += glm::dot(value, value);
        const double scale = tolerance * std::sqrt(squares / static_cast<double>(expected.size())) + 1e-30;
        for (std::size_t n = 0; n < expected.size(); ++n) add(actual[n], expected[n], scale);
    }
    /// By each that is expected.
    void add(const std::vector<double>& actual, const std::vector<double>& expected, double tolerance) {
        for (std::size_t n = 0; n < expected.size(); ++n)
            add(actual[n], expected[n], tolerance * std::abs(expected[n]) + 1e-30);
    }
    void require(bool is_right) { add(is_right ? 0.0 : kInfinite, 0.0, 1.0); }

    double worst() const { return worst_; }

private:
    static constexpr double kInfinite = std::numeric_limits<double>::infinity();
    double worst_ = 0.0;
};

}  // namespace gelatin::test
