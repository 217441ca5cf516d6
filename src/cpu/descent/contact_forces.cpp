#include "cpu/descent/contact_forces.h"

#include <cmath>
#include <limits>
#include <utility>

#include "cpu/collision/colliders.h"
#include "cpu/contact/contact_force_sums.h"

namespace gelatin::cpu {
namespace {

template <class Real>
void add_presses(const Contacts<Real>& contacts, std::span<const Vec4<Real>> positions,
                 ContactForceSums& sums) {
    const ContactAims<Real>& aims = contacts.aims();
    for (const Press<Real>& press : aims.presses()) {
        const ContactPair& pair = contacts.list().pairs[press.pair];
        const Real pressing = contact_force(aims.gap(pair, press, positions), press.reach, press.stiffness);
        if (!(pressing > Real(0))) continue;
        // On the first side.
        const glm::dvec3 normal = -static_cast<double>(pressing) * glm::dvec3(press.normal),
                         friction(aims.held(press.pair));
        if (!pair.is_own()) sums.add(pair.object, pair.other, false, normal, friction);
        for (std::size_t k = 0; k < 4; ++k) {
            const auto weight = static_cast<double>(press.weights[static_cast<int>(k)]);
            const double share = pair.side_of(k) == 0 ? weight : -weight;
            sums.add_to_node(pair.nodes[k], share * normal, share * friction);
        }
    }
}

// The plane that a node is on, with this normal.
template <class Real>
std::uint32_t plane_of(const Model& model, const Vec3<Real>& position, const Vec3<Real>& normal) {
    std::uint32_t nearest = 0;
    Real least = std::numeric_limits<Real>::infinity();
    for (std::uint32_t c = 0; c < model.colliders.size(); ++c) {
        const SurfaceDistance<Real> surface = surface_distance(model.colliders[c], position);
        const Real away = std::abs(surface.distance) + (Real(1) - glm::dot(surface.normal, normal));
        if (away < least) {
            least = away;
            nearest = c;
        }
    }
    return nearest;
}

template <class Real>
void add_planes(const Model& model, const ColliderContacts<Real>& planes, std::span<const Vec3<Real>> forces,
                std::span<const Vec4<Real>> positions, ContactForceSums& sums) {
    for (std::uint32_t o = 0; o < model.body_count(); ++o) {
        if (planes.nodes.empty() || planes.objects[o] == 0) continue;
        const Range& nodes = model.objects[o].nodes;
        // What sweeps have left over on other nodes would have reached the planes, too.
        glm::dvec3 rest(0.0);
        double sum = 0.0;
        for (std::uint32_t n = nodes.first; n < nodes.end(); ++n) {
            const glm::dvec3 force = glm::dvec3(forces[n]) + sums.at_node(n);
            if (planes.nodes[n].along == Real(0)) {
                rest += force;
            } else {
                sum += glm::length(force);
            }
        }
        for (std::uint32_t n = nodes.first; n < nodes.end(); ++n) {
            const ColliderContact<Real>& contact = planes.nodes[n];
            if (contact.along == Real(0) || !(sum > 0.0)) continue;
            const glm::dvec3 own = glm::dvec3(forces[n]) + sums.at_node(n), direction(contact.normal);
            const glm::dvec3 force = -own - glm::length(own) / sum * rest;
            const glm::dvec3 normal = glm::dot(force, direction) * direction;
            sums.add(o, plane_of(model, Vec3<Real>(positions[n]), contact.normal), true, normal,
                     force - normal);
            sums.add_to_node(n, normal, force - normal);
        }
    }
}

}  // namespace

template <class Real>
ContactForces find_contact_forces(const Model& model, const Contacts<Real>* contacts,
                                  const ColliderContacts<Real>& planes, std::span<const Vec3<Real>> forces,
                                  std::span<const Vec4<Real>> positions) {
    ContactForceSums sums(model);
    if (contacts != nullptr) add_presses(*contacts, positions, sums);
    add_planes(model, planes, forces, positions, sums);
    return sums.take();
}

template ContactForces find_contact_forces<float>(const Model&, const Contacts<float>*,
                                                  const ColliderContacts<float>&,
                                                  std::span<const Vec3<float>>, std::span<const Vec4<float>>);
template ContactForces find_contact_forces<double>(const Model&, const Contacts<double>*,
                                                   const ColliderContacts<double>&,
                                                   std::span<const Vec3<double>>,
                                                   std::span<const Vec4<double>>);

}  // namespace gelatin::cpu
