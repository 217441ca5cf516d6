#pragma once

#include <cmath>
#include <glm/vec3.hpp>
#include <random>

namespace gelatin::test {

/// Random numbers and points for tests; the same for the same seed.
class RandomMaker {
public:
    explicit RandomMaker(unsigned seed) : random_(seed) {}

    double uniform(double low, double high) {
        return std::uniform_real_distribution<double>(low, high)(random_);
    }
    /// Evenly spread over the orders of magnitude between two positive numbers.
    double magnitude(double low, double high) { return std::exp(uniform(std::log(low), std::log(high))); }
    int integer(int low, int high) { return std::uniform_int_distribution<int>(low, high)(random_); }
    glm::dvec3 point(double extent = 1.0) {
        return {uniform(-extent, extent), uniform(-extent, extent), uniform(-extent, extent)};
    }

private:
    std::mt19937 random_;
};

}  // namespace gelatin::test
