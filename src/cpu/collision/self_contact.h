#pragma once

#include "cpu/collision/contact.h"

namespace gelatin::cpu {

/// A face as one of those sees it that it touches: as one lump. A node's mass is divided evenly among its
/// colliding faces, and a face's among those that it touches, so that no mass is there twice and answers add
/// up.
template <class Real>
struct FaceLump {
    Real mass = 0;           ///< of the corners that are not pinned [kg]
    Vec3<Real> velocity{0};  ///< of the same; of all where all are pinned [m/s]
    Vec3<Real> way{0};       ///< that they went in this step [m]
    Vec3<Real> center{0};    ///< of all corners [m]
    Vec3<Real> normal{0};    ///< outward, unit; 0 of a flat face
};

/// What a face's corners change by.
template <class Real>
struct LumpResponse {
    Vec3<Real> velocity{0};  ///< [m/s]
    Vec3<Real> way{0};       ///< [m]
};

/// The answer of a face to another of its own object that it touches: an inelastic impact of two lumps along
/// the mean of their normals, with friction; and back to where they have come from, along the normal. With
/// the faces exchanged it is the opposite, to the last bit of the impulse.
/// @param resting_speed slower than this [m/s], nothing bounces
template <class Real>
LumpResponse<Real> self_response(const FaceLump<Real>& face, const FaceLump<Real>& other,
                                 const ContactProperties& properties, Real resting_speed) {
    const auto mobility = [](Real mass) { return mass > Real(0) ? Real(1) / mass : Real(0); };
    const auto length_or_one = [](const Vec3<Real>& v) {
        const Real length = glm::length(v);
        return length > Real(0) ? length : Real(1);
    };
    Vec3<Real> normal = face.normal - other.normal;
    if (glm::dot(normal, normal) < Real(1e-4)) normal = other.center - face.center;  // they face the same way
    normal /= length_or_one(normal);

    LumpResponse<Real> response;
    const Real ours = mobility(face.mass), both = ours + mobility(other.mass);
    const Vec3<Real> relative = face.velocity - other.velocity;
    const Real approach = glm::dot(relative, normal);
    if (!(approach > Real(0)) || !(both > Real(0))) return response;

    const Real restitution = approach > resting_speed ? static_cast<Real>(properties.restitution) : Real(0);
    const Real impulse = (Real(1) + restitution) * approach / both;
    const Vec3<Real> sliding = relative - approach * normal;
    const Real speed = glm::length(sliding);
    const Real most = static_cast<Real>(properties.friction) * impulse;
    const Real braking = std::min(speed / both, most);  // Coulomb [N s]
    response.velocity = -ours * (impulse * normal + braking / length_or_one(sliding) * sliding);

    const Real advance = glm::dot(face.way - other.way, normal);
    response.way = -ours / both * std::max(advance, Real(0)) * normal;
    return response;
}

}  // namespace gelatin::cpu
