#pragma once

#include <glm/gtc/quaternion.hpp>
#include <glm/vec4.hpp>
#include <random>

namespace gelatin::test {

/// Random components, the last one first. The arguments of a call are evaluated in an order that differs
/// between compilers, and so would vectors made of three draws there.
template <class Vector, class Distribution>
Vector draw_vector(Distribution& distribution, std::mt19937& random) {
    Vector vector;
    for (int k = Vector::length(); k-- > 0;) vector[k] = distribution(random);
    return vector;
}

/// @return a rotation; their distribution over all rotations is not uniform
template <class Distribution>
glm::dquat draw_rotation(Distribution& distribution, std::mt19937& random) {
    const auto v = draw_vector<glm::dvec4>(distribution, random);
    return glm::normalize(glm::dquat(v.x, v.y, v.z, v.w));
}

}  // namespace gelatin::test
