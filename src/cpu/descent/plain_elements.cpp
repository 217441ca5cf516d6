#include "cpu/descent/plain_elements.h"

#include <utility>

#include "cpu/descent/spring_terms.h"
#include "cpu/elasticity/neo_hookean.h"
#include "cpu/elasticity/volume_ratios.h"
#include "model/elasticity/neo_hookean.h"
#include "model/for_each_index.h"

namespace gelatin::cpu {

void PlainTerms::add(std::size_t r, const NodeTerms<double>& terms) {
    rows[r].force += terms.force;
    rows[r].hessian.diagonal += terms.hessian.diagonal;
    rows[r].hessian.beside += terms.hessian.beside;
}

PlainElements::PlainElements(std::shared_ptr<const Model> model, DescentRows&, const NodeTets& node_tets)
    : model_(std::move(model)), node_tets_(node_tets), object_of_(objects_of_nodes(*model_)) {
    if (model_->volume_term.is_empty()) return;
    node_pressures_.resize(model_->node_count());
    bounds_.resize(model_->tets.size());
}

void PlainElements::update(const DescentRows&, const DescentBatch& batch, std::span<const double> ratios) {
    if (bounds_.empty()) return;
    const Model& model = *model_;
    const VolumeTerm& term = model.volume_term;
    for_each_index(batch.nodes, [&](std::uint32_t n) {
        double volume = 0.0;
        for (std::uint32_t e = node_tets_.starts[n]; e < node_tets_.starts[n + 1]; ++e) {
            const std::uint32_t t = node_tets_.entries[e] / 4;
            volume += 0.25 * ratios[t] * static_cast<double>(model.tet_rests[t].volume);
        }
        const glm::dvec2 rest(term.nodes[n]);
        node_pressures_[n] = rest.x > 0.0 ? volume_stress(volume / rest.x, rest.y) : 0.0;
    });
    for_each_index(batch.tets, [&](std::uint32_t t) {
        double sum = 0.0;
        for (int k = 0; k < 4; ++k) sum += node_pressures_[model.tets[t][k]];
        const auto volume = static_cast<double>(model.tet_rests[t].volume),
                   modulus = static_cast<double>(term.tets[t]);
        bounds_[t] = {volume * (0.25 * sum - modulus * ratios[t]), volume * modulus};
    });
}

void PlainElements::gather(const DescentRows& rows, const StepState<double>& step, std::size_t group,
                           std::span<const glm::dvec4> positions, PlainTerms& terms) const {
    for (std::uint32_t r = 0; r < kGroup; ++r) {
        const auto row = static_cast<std::uint32_t>(group * kGroup + r);
        const std::uint32_t node = rows.nodes[row];
        if (node == kNoNode) continue;
        NodeTerms<double>& sum = terms.rows[r];
        const glm::dvec4& target = step.targets[node];
        add_point_spring(glm::dvec3(target - positions[node]), target.w, sum);
        add_springs(rows, step, row, positions, sum);
        if (has_neo_hookean_tets(*model_, node)) {
            add_neo_hookean_tets(step, node, positions, sum);
        } else if (!bounds_.empty()) {
            add_volumes(node, positions, sum);
        }
    }
}

std::uint32_t PlainElements::descend(const DescentRows& rows, const StepState<double>& step,
                                     std::size_t group, std::span<glm::dvec4> positions,
                                     PlainTerms& terms) const {
    gather(rows, step, group, positions, terms);
    std::uint32_t moved = 0;
    for (std::uint32_t r = 0; r < kGroup; ++r) {
        const std::uint32_t node = rows.nodes[group * kGroup + r];
        if (node == kNoNode || step.targets[node].w == 0.0) continue;
        positions[node] += glm::dvec4(solve(terms.rows[r]), 0.0);
        moved |= 1u << r;
    }
    return moved;
}

void PlainElements::add_springs(const DescentRows& rows, const StepState<double>& step, std::uint32_t row,
                                std::span<const glm::dvec4> positions, NodeTerms<double>& terms) const {
    add_row_springs<double>({rows, positions.data(), step.starts.data(), step.inverse_step}, row, terms);
}

void PlainElements::add_neo_hookean_tets(const StepState<double>& step, std::uint32_t node,
                                         std::span<const glm::dvec4> positions,
                                         NodeTerms<double>& terms) const {
    const NodeTets& corners = model_->neo_hookean_corners;
    const ModelObject& object = model_->objects[object_of_[node]];
    const std::uint32_t first_tet = object.tets.first - object.neo_hookean_tets.first;
    for (std::uint32_t e = corners.starts[node]; e < corners.starts[node + 1]; ++e) {
        const std::uint32_t index = corners.entries[e] / 4;
        const NeoHookeanTet& tet = model_->neo_hookean_tets[index];
        const TetModuli<double> moduli = tet_moduli<double>(tet);
        const glm::dvec3 g = shape_gradient<double>(tet, corners.entries[e] % 4);
        const glm::dmat3 f = gradient_of(tet, at_corners(tet, positions.data()));
        const TetAtCorner<double> at_corner = tet_at_corner<double>(g, f);
        add_neo_hookean(at_corner, moduli,
                        bounds_.empty() ? VolumeBound<double>() : bounds_[first_tet + index], terms);
        terms.force += opening_force(g, at_corner.squares, moduli.mu);
        const double damping_time = mean_damping_time(tet, step.starts.data());
        if (damping_time > 0.0) {
            const glm::dmat3 before = gradient_of(tet, at_corners(tet, step.starts.data()));
            add_viscosity(g, f, before, moduli, damping_time * step.inverse_step, terms);
        }
    }
}

void PlainElements::add_volumes(std::uint32_t node, std::span<const glm::dvec4> positions,
                                NodeTerms<double>& terms) const {
    for_each_volume_slope(*model_, node_tets_, node, positions.data(),
                          [&](std::uint32_t tet, const glm::dvec3& slope, double ratio) {
                              add_tet_volume(slope, ratio, bounds_[tet], terms);
                          });
}

}  // namespace gelatin::cpu
