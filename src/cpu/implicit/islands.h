#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "cpu/implicit/contact_row.h"
#include "cpu/nodes.h"
#include "model/model.h"

namespace gelatin::cpu {

/// Bodies that touch each other in a step. An island has the number of its first body.
struct Islands {
    std::vector<std::uint32_t> of_bodies;
    // By island:
    std::vector<std::uint8_t> are_held;  ///< whether anything holds, carries or drives it
    std::vector<double> masses;          ///< [kg]
    /// How what nothing holds moves on as a whole, and what handles carry, if nothing else holds it: this is
    /// no motion of its bodies beside each other. 0 of others [m/s].
    std::vector<glm::dvec3> velocities;

    /// @param has_forces whether loads or hands act
    template <class Real>
    void find(const Model& model, std::span<const ContactRow<Real>> rows, const Nodes<Real>& nodes,
              bool has_forces);
};

}  // namespace gelatin::cpu
