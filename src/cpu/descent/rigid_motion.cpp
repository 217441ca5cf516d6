#include "cpu/descent/rigid_motion.h"

#include <algorithm>
#include <glm/matrix.hpp>

namespace gelatin::cpu {
namespace {

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

void RigidSums::add(const RigidSums& other, double factor) {
    stiffness += factor * other.stiffness;
    arm += factor * other.arm;
    square.diagonal += factor * other.square.diagonal;
    square.beside += factor * other.square.beside;
    force += factor * other.force;
    moment += factor * other.moment;
}

// What slides is resisted along the normal by a little more than that, which spares sums.
void RigidStep::add(const glm::dvec3& r, const RigidContact& contact) {
    const bool slides = contact.across < contact.along;
    const glm::dvec3 pressing = contact.pressing * contact.normal;
    sums_.add(r, slides ? 0.0 : contact.across, slides ? pressing : pressing + contact.friction);
    add_along(r, contact.normal, slides ? contact.along : contact.along - contact.across);
    if (slides) sliding_.add(r, contact.across, contact.friction);
    pressing_ += contact.pressing;
    pressing_translation_ += contact.along * contact.normal;
    pressing_rotation_ += contact.along * glm::cross(r, contact.normal);
}

void RigidStep::add_along(const glm::dvec3& r, const glm::dvec3& normal, double stiffness) {
    const glm::dvec3 rotated = glm::cross(r, normal);
    translations_.add_outer(stiffness, normal);
    rotations_.add_outer(stiffness, rotated);
    mixed_ += stiffness * glm::outerProduct(normal, rotated);
}

// [A B; B^T C] (s, w) = (force, moment) by elimination of s.
RigidStep::Displacement RigidStep::displacement(const RigidSums& sums) const {
    const glm::dmat3 identity(1.0);
    const double trace = sums.square.diagonal.x + sums.square.diagonal.y + sums.square.diagonal.z;
    const glm::dmat3 a = sums.stiffness * identity + full(translations_);
    const glm::dmat3 b = mixed_ - cross(sums.arm);
    const glm::dmat3 c = trace * identity - full(sums.square) + full(rotations_);
    const glm::dmat3 a_inverse = glm::inverse(a);
    const glm::dmat3 rest = c - glm::transpose(b) * a_inverse * b;
    const glm::dvec3 left = sums.moment - glm::transpose(b) * (a_inverse * sums.force);
    SymmetricMatrix<double> inertia;
    inertia.diagonal = {rest[0][0], rest[1][1], rest[2][2]};
    inertia.beside = {rest[1][2], rest[2][0], rest[0][1]};
    const glm::dvec3 w = cpu::solve(inertia, left);
    return {a_inverse * (sums.force - b * w), w};
}

RigidMotion RigidStep::solve(const glm::dvec3& origin) const {
    RigidSums sums = sums_;
    sums.add(sliding_);
    Displacement found = displacement(sums);
    if (sliding_.stiffness > 0.0 && pressing_ > 0.0) {
        const double fall =
            glm::dot(pressing_translation_, found.translation) + glm::dot(pressing_rotation_, found.rotation);
        sums.add(sliding_, std::clamp(1.0 - fall / pressing_, 0.0, 1.0) - 1.0);
        found = displacement(sums);
    }
    // A rotation about the centre of mass does not move it, however large.
    const glm::dvec3 center = sums.arm / sums.stiffness;
    return {origin + center, found.translation + glm::cross(found.rotation, center),
            cayley_rotation(found.rotation)};
}

}  // namespace gelatin::cpu
