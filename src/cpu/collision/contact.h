#pragma once

#include <algorithm>
#include <glm/geometric.hpp>

#include "cpu/nodes.h"
#include "model/shared_constants.h"

namespace gelatin::cpu {

/// One side of two objects that touch (shaders/layouts/contact.glsl). A colliding face gives each of its
/// corners a share of the node's mass, so that a node's shares over all its colliding faces add up to its
/// mass.
template <class Real>
struct ContactPatch {
    Vec3<Real> area_normal{0};  ///< sum of the colliding faces' weighted area normals [m^2]
    Real mass = 0;              ///< of the corners that are not pinned [kg]
    Vec3<Real> momentum{0};     ///< of the same corners [kg m/s]
    std::uint32_t pinned = 0;   ///< number of pinned corners
    Vec3<Real> held{0};         ///< sum of their velocities [m/s]
};

/// The weight in a patch's normal of faces that do not enter the other object
/// (src/cpu/collision/face_contact.h): they count where none does.
using thresholds::kWeightOfOthers;

/// The corners of a patch that approach the other object.
template <class Real>
struct ApproachSums {
    Vec3<Real> momentum{0};  ///< [kg m/s]
    Real mass = 0;           ///< [kg]
    Real impulse = 0;        ///< sum of mass times speed of approach [kg m/s]
};

/// The moving plane in which two patches touch.
template <class Real>
struct ContactPlane {
    Vec3<Real> normal;    ///< unit, from the first patch's object to the second's
    Vec3<Real> velocity;  ///< [m/s]
    bool pinned;          ///< a side is pinned: the plane has its velocity and takes any impulse
};

/// It moves with the patches' common velocity, or with the mean velocity of the pinned corners, which handles
/// may move.
/// @param between from the first object's centre to the second's: the normal if those of the faces cancel [m]
template <class Real>
ContactPlane<Real> contact_plane(const ContactPatch<Real>& patch, const ContactPatch<Real>& other,
                                 const Vec3<Real>& between) {
    const auto direction = [](const Vec3<Real>& v, const Vec3<Real>& otherwise) {
        const Real length = glm::length(v);
        return length > Real(0) ? v / length : otherwise;
    };
    const Vec3<Real> middle = direction(between, Vec3<Real>(0, 1, 0));
    const std::uint32_t pinned = patch.pinned + other.pinned;
    const Real mass = patch.mass + other.mass;
    Vec3<Real> velocity(0);
    if (pinned > 0) {
        velocity = (patch.held + other.held) / static_cast<Real>(pinned);
    } else if (mass > Real(0)) {
        velocity = (patch.momentum + other.momentum) / mass;
    }
    return {direction(patch.area_normal - other.area_normal, middle), velocity, pinned > 0};
}

/// A corner's velocity v changes by -factor u normal + slowing, where u = (v - velocity) . normal > 0.
template <class Real>
struct ContactResponse {
    Vec3<Real> normal{0};    ///< unit, towards the other object
    Real factor = 0;         ///< (1 + restitution), less if the other side has less momentum
    Vec3<Real> velocity{0};  ///< of the contact plane [m/s]
    Vec3<Real> slowing{0};   ///< by friction [m/s]
};

struct ContactProperties {
    double friction, restitution;
};

/// The response of the side `patch` to a contact with the side `other`. The corners of both sides that
/// approach the contact plane leave it with the restitution, and the impulses of the two sides are equal and
/// opposite. See docs/collision.md. A pinned side takes any impulse.
/// @param resting_speed below this speed [m/s], nothing bounces
template <class Real>
ContactResponse<Real> contact_response(const ContactPlane<Real>& plane, const ApproachSums<Real>& approach,
                                       const ApproachSums<Real>& other, const ContactProperties& properties,
                                       Real resting_speed) {
    ContactResponse<Real> response;
    response.normal = plane.normal;
    response.velocity = plane.velocity;
    const Real impulse = plane.pinned ? approach.impulse : std::min(approach.impulse, other.impulse);
    if (impulse <= Real(0)) return response;

    const auto mobility = [](Real mass) { return mass > Real(0) ? Real(1) / mass : Real(0); };
    const Real mobilities = mobility(approach.mass) + (plane.pinned ? Real(0) : mobility(other.mass));
    const Real restitution =
        impulse * mobilities > resting_speed ? static_cast<Real>(properties.restitution) : Real(0);
    response.factor = (Real(1) + restitution) * impulse / approach.impulse;

    const Vec3<Real> other_velocity = plane.pinned ? plane.velocity : other.momentum * mobility(other.mass);
    const Vec3<Real> relative = approach.momentum * mobility(approach.mass) - other_velocity;
    const Vec3<Real> sliding = relative - glm::dot(relative, plane.normal) * plane.normal;
    const Real speed = glm::length(sliding);
    if (speed <= Real(0)) return response;
    const Real most = static_cast<Real>(properties.friction) * (Real(1) + restitution) * impulse;
    const Real braking = std::min(speed / mobilities, most);  // Coulomb [N s]
    response.slowing = sliding * (-braking * mobility(approach.mass) / speed);
    return response;
}

}  // namespace gelatin::cpu
