#pragma once

#include <Eigen/Core>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include "cpu/implicit/rigid_inertia.h"
#include "cpu/nodes.h"

namespace gelatin::cpu {

using Motion = Eigen::Matrix<double, 6, 1>;  ///< a translation [m] and a rotation, or a force and a moment
using MotionMatrix = Eigen::Matrix<double, 6, 6>;

inline Motion motion(const glm::dvec3& translation, const glm::dvec3& rotation) {
    Motion m;
    m << translation.x, translation.y, translation.z, rotation.x, rotation.y, rotation.z;
    return m;
}
inline glm::dvec3 translation(const Motion& m) {
    return {m(0), m(1), m(2)};
}
inline glm::dvec3 rotation(const Motion& m) {
    return {m(3), m(4), m(5)};
}
/// What a motion displaces at an arm from the body's centre [m].
template <class Real>
Vec3<Real> displacement(const Motion& m, const Vec3<Real>& arm) {
    return Vec3<Real>(translation(m)) + glm::cross(Vec3<Real>(rotation(m)), arm);
}

/// sum k J^T J, J (s, w) = s + w x r.
inline MotionMatrix inertia_matrix(const RigidSums& sums) {
    const SymmetricMatrix<double> about = inertia_of(sums.square);
    const glm::dvec3 &b = about.beside, &a = sums.arm;
    MotionMatrix m = MotionMatrix::Zero();
    m.diagonal() = motion(glm::dvec3(sums.stiffness), about.diagonal);
    m(3, 4) = m(4, 3) = b.z;
    m(4, 5) = m(5, 4) = b.x;
    m(5, 3) = m(3, 5) = b.y;
    m(0, 4) = m(4, 0) = a.z;
    m(0, 5) = m(5, 0) = -a.y;
    m(1, 5) = m(5, 1) = a.x;
    m(1, 3) = m(3, 1) = -a.z;
    m(2, 3) = m(3, 2) = a.y;
    m(2, 4) = m(4, 2) = -a.x;
    return m;
}

}  // namespace gelatin::cpu
