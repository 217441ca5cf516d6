#pragma once

#include <cstdint>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <glm/vec3.hpp>

#include "model/model.h"

namespace gelatin::cpu {

/// Of points that are at a, and at b: both middles [m], and the sum of b a^T, both from their middles [m^2].
struct MomentBetween {
    glm::dvec3 middle_a{0.0}, middle_b{0.0};
    glm::dmat3 moment{0.0};
};

/// @param a, b of an index of `range`; sums are relative to its first, for precision
template <class A, class B>
MomentBetween moment_between(const Range& range, const A& a, const B& b) {
    const glm::dvec3 first_a(a(range.first)), first_b(b(range.first));
    glm::dvec3 sum_a(0.0), sum_b(0.0);
    MomentBetween between;
    for (std::uint32_t k = range.first; k < range.end(); ++k) {
        const glm::dvec3 at_a = glm::dvec3(a(k)) - first_a, at_b = glm::dvec3(b(k)) - first_b;
        sum_a += at_a;
        sum_b += at_b;
        between.moment += glm::outerProduct(at_b, at_a);
    }
    const auto count = static_cast<double>(range.count);
    between.moment -= glm::outerProduct(sum_b, sum_a) / count;
    between.middle_a = first_a + sum_a / count;
    between.middle_b = first_b + sum_b / count;
    return between;
}

}  // namespace gelatin::cpu
