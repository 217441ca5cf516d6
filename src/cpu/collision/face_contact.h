#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>

#include "cpu/collision/time_of_impact.h"
#include "model/shared_constants.h"

namespace gelatin::cpu {

/// How a face touches another object, two bits of the Face Collision Result. One that `enters` moves outwards
/// as seen from a face that it touches: it stands for its side of the contact, as the front of a body that
/// flies right through another does, and its back does not. Discrete detection takes every face for one.
enum class FaceContact : std::uint32_t { none = 0, touches = 1, enters = 3 };

/// How two faces touch, each as it sees the other.
struct FaceContacts {
    FaceContact ours = FaceContact::none, theirs = FaceContact::none;
};

/// Faces whose planes meet at less than this from a right angle, by its sine, enter nothing: when a box
/// slides over another one, its sides are no contact.
using thresholds::kAcross;

/// How two faces touch. @pre they do within the step. GLSL twin: shaders/sim/collision/face_contact.glsl
template <class Real>
FaceContacts face_contacts(const Moving<Real, 3>& face, const Moving<Real, 3>& other) {
    const auto unit_normal = [](const std::array<Vec3<Real>, 3>& corners) {
        const Vec3<Real> normal = glm::cross(corners[1] - corners[0], corners[2] - corners[0]);
        const Real length = glm::length(normal);
        return length > Real(0) ? normal / length : Vec3<Real>(0);
    };
    const Vec3<Real> normal = unit_normal(face.start), other_normal = unit_normal(other.start);
    if (std::abs(glm::dot(normal, other_normal)) < static_cast<Real>(kAcross))
        return {FaceContact::touches, FaceContact::touches};
    Vec3<Real> relative(0);  // three times the face's displacement, as seen from the other
    for (int k = 0; k < 3; ++k) relative += (face.end[k] - face.start[k]) - (other.end[k] - other.start[k]);
    return {glm::dot(relative, normal) > Real(0) ? FaceContact::enters : FaceContact::touches,
            glm::dot(relative, other_normal) < Real(0) ? FaceContact::enters : FaceContact::touches};
}

}  // namespace gelatin::cpu
