#pragma once

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

#include "cpu/nodes.h"

namespace gelatin::cpu {

/// Maps flatter than this, by their determinant, or longer, by their square (Frobenius), have no turn.
constexpr double kFlattestTurned = 0.02, kLargestTurned = 50.0;

/// The turn nearest to a map: the orthogonal factor of its polar decomposition, by Newton's method (Higham
/// 1986: "Computing the polar decomposition - with applications"). No turn if the map is far from being one.
/// GLSL twin: shaders/include/nearest_turn.glsl.
template <class Real>
glm::mat<3, 3, Real> nearest_turn(const glm::mat<3, 3, Real>& map) {
    using Mat = glm::mat<3, 3, Real>;
    const Real square = glm::dot(map[0], map[0]) + glm::dot(map[1], map[1]) + glm::dot(map[2], map[2]);
    if (!(glm::determinant(map) > Real(kFlattestTurned) && square < Real(kLargestTurned))) return Mat(1);
    Mat turn = map;
    for (int i = 0; i < 10; ++i) turn = Real(0.5) * (turn + glm::transpose(glm::inverse(turn)));
    return turn;
}

}  // namespace gelatin::cpu
