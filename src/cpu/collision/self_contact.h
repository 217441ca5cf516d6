#pragma once

#include "cpu/collision/contact.h"

namespace gelatin::cpu {

/// A face in a contact with another face of its object, treated as one point mass. A node's mass is divided
/// evenly among its colliding faces, and a face's mass among the faces that it touches. So no mass counts
/// twice, and responses add up.
template <class Real>
struct FaceLump {
    Real mass = 0;               ///< of the corners that are not pinned [kg]
    Vec3<Real> velocity{0};      ///< of the same; of all corners if all are pinned [m/s]
    Vec3<Real> displacement{0};  ///< their displacement in this step [m]
    Vec3<Real> center{0};        ///< centre of all corners [m]
    Vec3<Real> normal{0};        ///< outward, unit; 0 for a flat face
};

/// The change of a face's corners.
template <class Real>
struct LumpResponse {
    Vec3<Real> velocity{0};      ///< [m/s]
    Vec3<Real> displacement{0};  ///< [m]
};

/// The response of a face to another face of its own object that it touches: an inelastic impact of two point
/// masses along the mean of their normals, with friction; and a return to their previous positions along the
/// normal. With the faces exchanged the impulse is the opposite, to the last bit.
/// @param resting_speed below this speed [m/s], nothing bounces
template <class Real>
LumpResponse<Real> self_response(const FaceLump<Real>& face, const FaceLump<Real>& other,
                                 const ContactProperties& properties, Real resting_speed) {
    const auto mobility = [](Real mass) { return mass > Real(0) ? Real(1) / mass : Real(0); };
    const auto length_or_one = [](const Vec3<Real>& v) {
        const Real length = glm::length(v);
        return length > Real(0) ? length : Real(1);
    };
    Vec3<Real> normal = face.normal - other.normal;
    if (glm::dot(normal, normal) < Real(1e-4)) normal = other.center - face.center;  // their normals coincide
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

    const Real advance = glm::dot(face.displacement - other.displacement, normal);
    response.displacement = -ours / both * std::max(advance, Real(0)) * normal;
    return response;
}

}  // namespace gelatin::cpu
