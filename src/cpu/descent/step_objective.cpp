#include "cpu/descent/step_objective.h"

#include "model/for_each_index.h"

namespace gelatin::cpu {

template <class Real>
StepObjective<Real>::StepObjective(std::shared_ptr<const Model> model, std::uint32_t nodes_a_batch)
    : step{std::vector<Vec4<Real>>(model->node_count()), std::vector<Vec4<Real>>(model->node_count())},
      rows_(make_descent_rows(*model, nodes_a_batch)),
      flat_tets_(model, rows_),
      elements_(model, rows_, flat_tets_.node_tets()) {}

template <class Real>
void StepObjective<Real>::begin(Real seconds) {
    step.inverse_step = Real(1) / seconds;
    elements_.begin(rows_, step);
}

template <class Real>
void StepObjective<Real>::update(std::size_t batch, TetUpdate update,
                                 const std::vector<Vec4<Real>>& positions) {
    if (update == TetUpdate::none) return;
    flat_tets_.update(batch, rows_, positions);
    if (update == TetUpdate::all) elements_.update(rows_, rows_.batches[batch], flat_tets_.ratios());
}

template <class Real>
void StepObjective<Real>::add_flat_tets(std::size_t group, const std::vector<Vec4<Real>>& positions,
                                        Terms& terms) const {
    for (std::uint32_t r = 0; r < kGroup; ++r) {
        const std::uint32_t node = rows_.nodes[group * kGroup + r];
        if (node == kNoNode) continue;
        NodeTerms<Real> sum;
        flat_tets_.add(node, positions, sum);
        terms.add(r, sum);
    }
}

template <class Real>
std::uint32_t StepObjective<Real>::descend(std::size_t group, bool any_flat,
                                           std::vector<Vec4<Real>>& positions, Terms& terms) const {
    if (any_flat) add_flat_tets(group, positions, terms);
    return elements_.descend(rows_, step, group, positions, terms);
}

template <class Real>
void StepObjective<Real>::find_forces(const std::vector<Vec4<Real>>& positions,
                                      std::vector<Vec3<Real>>& forces) const {
    const bool any_flat = any_flat_tets();
    for_each_index(0, group_count(), kGroupsATask, [&](std::size_t group) {
        Terms terms;  // of which the forces count
        if (any_flat) add_flat_tets(group, positions, terms);
        elements_.add_forces(rows_, step, group, positions, terms);
        for (std::uint32_t r = 0; r < kGroup; ++r) {
            const std::uint32_t node = rows_.nodes[group * kGroup + r];
            if (node != kNoNode && step.targets[node].w != Real(0)) forces[node] = terms.row(r).force;
        }
    });
}

template class StepObjective<float>;
template class StepObjective<double>;

}  // namespace gelatin::cpu
