#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "cpu/contact/contact_list.h"
#include "cpu/nodes.h"
#include "model/model.h"

namespace gelatin::cpu {

/// The mean motion by mass of each island's bodies [m]; none where one of them stays.
/// @param motions means of bodies [m], shape [bodies], or empty: none
/// @param stays by body: not 0 if it takes no part in what its island does
template <class Real>
std::vector<Vec3<Real>> island_motions(const Model& model, const ContactList<Real>& list,
                                       std::span<const Vec3<Real>> motions,
                                       std::span<const std::uint8_t> stays) {
    const std::size_t islands = list.is_alone.size();
    std::vector<glm::dvec3> sums(islands, glm::dvec3(0.0));
    std::vector<double> masses(islands);
    std::vector<std::uint8_t> has_staying(islands);
    for (std::size_t o = 0; o < motions.size(); ++o) {
        const std::uint32_t i = list.islands[o];
        sums[i] += model.objects[o].mass * glm::dvec3(motions[o]);
        masses[i] += model.objects[o].mass;
        has_staying[i] |= stays[o];
    }
    std::vector<Vec3<Real>> means(islands, Vec3<Real>(0));
    for (std::size_t i = 0; i < islands; ++i)
        if (has_staying[i] == 0 && masses[i] > 0.0) means[i] = Vec3<Real>(sums[i] / masses[i]);
    return means;
}

}  // namespace gelatin::cpu
