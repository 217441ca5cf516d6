#pragma once

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/mat4x4.hpp>

namespace gelatin::cpu {

/// The rotation R for which tr(R^T moment) is largest, a proper one for any moment: of unit quaternions the
/// one for which Horn's symmetric 4x4 matrix has the largest eigenvalue (B. K. P. Horn: Closed-form Solution
/// of Absolute Orientation Using Unit Quaternions, Journal of the Optical Society of America A 4(4), 1987).
/// Squared again and again, that matrix becomes the projection onto it. GLSL twin:
/// shaders/sim/descent/nearest_rotation.glsl.
/// @param moment the sum of x X^T, for nodes at X that have come to x
inline glm::dmat3 nearest_rotation(const glm::dmat3& moment) {
    constexpr int kSquarings = 20;
    const glm::dvec3 &a = moment[0], &b = moment[1], &c = moment[2];  // x X_x, x X_y, x X_z
    const glm::dvec3 rotated(b.z - c.y, c.x - a.z, a.y - b.x);
    glm::dmat4 m(a.x + b.y + c.z, rotated.x, rotated.y, rotated.z,  //
                 rotated.x, a.x - b.y - c.z, a.y + b.x, c.x + a.z,  //
                 rotated.y, a.y + b.x, b.y - a.x - c.z, b.z + c.y,  //
                 rotated.z, c.x + a.z, b.z + c.y, c.z - a.x - b.y);
    const glm::dvec4 sums = glm::abs(m[0]) + glm::abs(m[1]) + glm::abs(m[2]) + glm::abs(m[3]);
    const double size = sums.x + sums.y + sums.z + sums.w;
    m = glm::dmat4(1.0) + m * (size > 0.0 ? 1.0 / size : 0.0);  // none of its eigenvalues is negative
    for (int k = 0; k < kSquarings; ++k) {
        m = m * m;
        m /= m[0][0] + m[1][1] + m[2][2] + m[3][3];
    }
    int longest = 0;
    for (int k = 1; k < 4; ++k)
        if (m[k][k] > m[longest][longest]) longest = k;
    const glm::dvec4 q = glm::normalize(m[longest]);
    const double w = q.x;
    const glm::dvec3 v(q.y, q.z, q.w);
    const glm::dmat3 cross(glm::dvec3(0.0, v.z, -v.y), glm::dvec3(-v.z, 0.0, v.x),
                           glm::dvec3(v.y, -v.x, 0.0));
    return glm::dmat3(1.0) + 2.0 * (w * cross + cross * cross);
}

}  // namespace gelatin::cpu
