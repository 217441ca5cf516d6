#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>

#include "cpu/collision/time_of_impact.h"

namespace gelatin::cpu {

/// How a face touches another object, two bits of the Face Collision Result. One that `enters` moves outwards
/// as seen from a face that it touches: it stands for its side of the contact, as the front of a body that
/// flies right through another does, and its back does not. Discrete detection takes every face for one.
enum class Touch : std::uint32_t { none = 0, touches = 1, enters = 3 };

/// How two faces touch, each as it sees the other.
struct Touches {
    Touch ours = Touch::none, theirs = Touch::none;
};

/// Faces whose planes meet at less than this from a right angle, by its sine, enter nothing: when a box
/// slides over another one, its sides are no contact.
constexpr double kAcross = 0.25;

/// @pre they touch on the way. GLSL twin: shaders/sim/collision/touch.glsl
template <class Real>
Touches touches_on_the_way(const Moving<Real, 3>& face, const Moving<Real, 3>& other) {
    const auto unit_normal = [](const std::array<Vec3<Real>, 3>& corners) {
        const Vec3<Real> normal = glm::cross(corners[1] - corners[0], corners[2] - corners[0]);
        const Real length = glm::length(normal);
        return length > Real(0) ? normal / length : Vec3<Real>(0);
    };
    const Vec3<Real> normal = unit_normal(face.start), other_normal = unit_normal(other.start);
    if (std::abs(glm::dot(normal, other_normal)) < static_cast<Real>(kAcross))
        return {Touch::touches, Touch::touches};
    Vec3<Real> way(0);  // three times the face's, as seen from the other
    for (int k = 0; k < 3; ++k) way += (face.end[k] - face.start[k]) - (other.end[k] - other.start[k]);
    return {glm::dot(way, normal) > Real(0) ? Touch::enters : Touch::touches,
            glm::dot(way, other_normal) < Real(0) ? Touch::enters : Touch::touches};
}

}  // namespace gelatin::cpu
