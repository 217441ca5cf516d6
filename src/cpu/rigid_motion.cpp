#include "cpu/rigid_motion.h"

#include <algorithm>
#include <glm/matrix.hpp>

namespace gelatin::cpu {
namespace {

// Of the mean moment of inertia, added to all three: nodes in one line or place have none about it.
constexpr double kLeastInertia = 1e-6;

glm::dmat3 full(const SymmetricMatrix<double>& m) {
    return {m.diagonal.x, m.beside.z, m.beside.y, m.beside.z,  m.diagonal.y,
            m.beside.x,   m.beside.y, m.beside.x, m.diagonal.z};
}

// [radians] Beyond that w x r is no turn any more, and the shift that goes with it on a surface leads
// anywhere.
constexpr double kLargestTurn = 1.0;

// cross(v) x = v x x
glm::dmat3 cross(const glm::dvec3& v) {
    return {0.0, v.z, -v.y, -v.z, 0.0, v.x, v.y, -v.x, 0.0};
}

}  // namespace

void RigidSums::add(const glm::dvec3& r, double k, const glm::dvec3& f) {
    stiffness += k;
    arm += k * r;
    square.add_outer(k, r);
    force += f;
    moment += glm::cross(r, f);
}

void RigidSums::add(const RigidSums& other) {
    stiffness += other.stiffness;
    arm += other.arm;
    square.diagonal += other.square.diagonal;
    square.beside += other.square.beside;
    force += other.force;
    moment += other.moment;
}

void RigidStep::add_along(const glm::dvec3& r, const glm::dvec3& normal, double stiffness) {
    const glm::dvec3 turned = glm::cross(r, normal);
    shifts_.add_outer(stiffness, normal);
    turns_.add_outer(stiffness, turned);
    mixed_ += stiffness * glm::outerProduct(normal, turned);
}

// [A B; B^T C] (s, w) = (force, moment) by elimination of s.
RigidMotion RigidStep::solve(const glm::dvec3& origin) const {
    const glm::dmat3 identity(1.0);
    const double trace = sums_.square.diagonal.x + sums_.square.diagonal.y + sums_.square.diagonal.z;
    // About the centre of stiffness, which is that of mass where nothing is touched.
    const double about_center = trace - glm::dot(sums_.arm, sums_.arm) / sums_.stiffness;
    const glm::dmat3 a = sums_.stiffness * identity + full(shifts_);
    const glm::dmat3 b = mixed_ - cross(sums_.arm);
    const glm::dmat3 c =
        (trace + kLeastInertia * 2.0 / 3.0 * about_center) * identity - full(sums_.square) + full(turns_);
    const glm::dmat3 a_inverse = glm::inverse(a);
    const glm::dmat3 rest = c - glm::transpose(b) * a_inverse * b;
    const glm::dvec3 left = sums_.moment - glm::transpose(b) * (a_inverse * sums_.force);
    SymmetricMatrix<double> inertia;
    inertia.diagonal = {rest[0][0], rest[1][1], rest[2][2]};
    inertia.beside = {rest[1][2], rest[2][0], rest[0][1]};
    glm::dvec3 w = cpu::solve(inertia, left);
    w *= std::min(1.0, kLargestTurn / glm::length(w));
    const glm::dvec3 s = a_inverse * (sums_.force - b * w);
    // A turn about the centre of mass does not move it, however large.
    const glm::dvec3 center = sums_.arm / sums_.stiffness;
    return {origin + center, s + glm::cross(w, center), cayley_turn(w)};
}

}  // namespace gelatin::cpu
