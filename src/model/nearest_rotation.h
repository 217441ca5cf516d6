#pragma once

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/mat3x3.hpp>
#include <glm/mat4x4.hpp>

namespace gelatin {

/// Of the rotations R for which tr(R^T moment) is largest, as unit quaternions (w, x, y, z): the eigenvectors
/// of the largest eigenvalue of Horn's symmetric 4x4 matrix (B. K. P. Horn: Closed-form Solution of Absolute
/// Orientation Using Unit Quaternions, Journal of the Optical Society of America A 4(4), 1987). Squared again
/// and again, that matrix becomes the projection onto them, times a factor.
/// @param moment the sum of x X^T, for nodes at X that have come to x
inline glm::dmat4 project_on_nearest_rotations(const glm::dmat3& moment) {
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
    return m;
}

/// The column of the projection that is least affected by rounding.
inline int longest_column(const glm::dmat4& projection) {
    int longest = 0;
    for (int k = 1; k < 4; ++k)
        if (projection[k][k] > projection[longest][longest]) longest = k;
    return longest;
}

/// The rotation R for which tr(R^T moment) is largest, a proper one for any moment. GLSL twin:
/// shaders/sim/recovery/nearest_rotation.glsl.
/// @param moment as above
inline glm::dmat3 nearest_rotation(const glm::dmat3& moment) {
    const glm::dmat4 m = project_on_nearest_rotations(moment);
    const glm::dvec4 q = glm::normalize(m[longest_column(m)]);
    const double w = q.x;
    const glm::dvec3 v(q.y, q.z, q.w);
    const glm::dmat3 cross(glm::dvec3(0.0, v.z, -v.y), glm::dvec3(-v.z, 0.0, v.x),
                           glm::dvec3(v.y, -v.x, 0.0));
    return glm::dmat3(1.0) + 2.0 * (w * cross + cross * cross);
}

/// The same as a quaternion; of several, as there are for nodes on a line, the smallest rotation.
inline glm::dquat smallest_nearest_rotation(const glm::dmat3& moment) {
    constexpr double kLeastCosine = 1e-6;  // squared, of half the angle; for larger ones rounding would count
    const glm::dmat4 m = project_on_nearest_rotations(moment);
    const glm::dvec4 q = glm::normalize(m[m[0][0] > kLeastCosine ? 0 : longest_column(m)]);
    return q.x < 0.0 ? glm::dquat(-q.x, -q.y, -q.z, -q.w) : glm::dquat(q.x, q.y, q.z, q.w);
}

}  // namespace gelatin
