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
    for (std::size_t o = 0; o < bodies; ++o) {
        const std::uint32_t island = of_bodies[o];
        const Range& range = model.objects[o].nodes;
        for (std::uint32_t n = range.first; n < range.end(); ++n) {
            if (nodes.positions[n].w == Real(0)) are_held[island] = 1;
            const auto mass = static_cast<double>(model.masses[n]);
            masses[island] += mass;
            velocities[island] += mass * glm::dvec3(nodes.velocities[n]);
        }
    }
    for (std::size_t i = 0; i < bodies; ++i)
        velocities[i] = are_held[i] != 0 || masses[i] == 0.0 ? glm::dvec3(0.0) : velocities[i] / masses[i];
}

template void Islands::find(const Model&, std::span<const ContactRow<float>>, const Nodes<float>&, bool);
template void Islands::find(const Model&, std::span<const ContactRow<double>>, const Nodes<double>&, bool);

}  // namespace gelatin::cpu
