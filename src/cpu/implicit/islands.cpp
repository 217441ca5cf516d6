#include "cpu/implicit/islands.h"

#include "core/disjoint_sets.h"

namespace gelatin::cpu {

template <class Real>
void Islands::find(const Model& model, std::span<const ContactRow<Real>> rows, const Nodes<Real>& nodes,
                   bool has_forces) {
    const std::size_t bodies = model.body_count();
    DisjointSets sets(bodies);
    const auto is_body = [&](std::uint32_t object) { return object != kNoNode && model.is_body(object); };
    for (const ContactRow<Real>& row : rows)
        if (is_body(row.object) && is_body(row.other)) sets.unite(row.object, row.other);
    of_bodies.resize(bodies);
    for (std::uint32_t o = 0; o < bodies; ++o) of_bodies[o] = sets.least(o);
    are_held.assign(bodies, has_forces ? 1 : 0);
    for (const ContactRow<Real>& row : rows)
        if (is_body(row.object) != is_body(row.other))
            are_held[of_bodies[is_body(row.other) ? row.other : row.object]] = 1;
    masses.assign(bodies, 0.0);
    velocities.assign(bodies, glm::dvec3(0.0));
    std::vector<double> held(bodies, 0.0);  // masses
    std::vector<glm::dvec3> carried(bodies, glm::dvec3(0.0));
    for (std::size_t o = 0; o < bodies; ++o) {
        const std::uint32_t island = of_bodies[o];
        const Range& range = model.objects[o].nodes;
        for (std::uint32_t n = range.first; n < range.end(); ++n) {
            const auto mass = static_cast<double>(model.masses[n]);
            const glm::dvec3 momentum = mass * glm::dvec3(nodes.velocities[n]);
            masses[island] += mass;
            velocities[island] += momentum;
            if (nodes.positions[n].w != Real(0)) continue;
            held[island] += mass;
            carried[island] += momentum;
        }
    }
    for (std::size_t i = 0; i < bodies; ++i) {
        if (are_held[i] != 0 || masses[i] == 0.0) {
            velocities[i] = glm::dvec3(0.0);
        } else if (held[i] > 0.0) {
            are_held[i] = 1;
            velocities[i] = carried[i] / held[i];
        } else {
            velocities[i] /= masses[i];
        }
    }
}

template void Islands::find(const Model&, std::span<const ContactRow<float>>, const Nodes<float>&, bool);
template void Islands::find(const Model&, std::span<const ContactRow<double>>, const Nodes<double>&, bool);

}  // namespace gelatin::cpu
