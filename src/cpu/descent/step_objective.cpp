#include "cpu/descent/step_objective.h"

#include <utility>

#include "cpu/descent/spring_terms.h"
#include "model/for_each_index.h"

namespace gelatin::cpu {
template <class Real>
StepObjective<Real>::StepObjective(std::shared_ptr<const Model> model, std::uint32_t nodes_a_batch)
    : starts(model->node_count()),
      targets(model->node_count()),
      model_(std::move(model)),
      has_damping_(model_->has_damping()),
      rows_(make_descent_rows(*model_, nodes_a_batch)),
      tets_(model_, rows_) {
    if constexpr (kIsFloat<Real>) {
        springs_ = make_spring_blocks(rows_);
        rows_.springs = {};
        if (has_damping_) damped_springs_ = springs_;
    }
}

template <class Real>
void StepObjective<Real>::begin(Real step) {
    inverse_step_ = Real(1) / step;
    if constexpr (kIsFloat<Real>) {
        if (has_damping_) damp_springs(springs_, rows_.nodes, starts.data(), inverse_step_, damped_springs_);
    }
}

template <class Real>
NodeTerms<Real> StepObjective<Real>::terms_of(std::uint32_t row,
                                              const std::vector<Vec4<Real>>& positions) const {
    const std::uint32_t node = rows_.nodes[row];
    const SpringRows<Real> springs{rows_, positions.data(), starts.data(), inverse_step_};
    NodeTerms<Real> terms = gather_spring_terms(springs, row);
    const Vec4<Real>& target = targets[node];
    add_inertia(Vec3<Real>(target - positions[node]), target.w, terms);
    tets_.add(node, positions, {starts.data(), inverse_step_}, terms);
    return terms;
}

template <class Real>
void StepObjective<Real>::find_forces(const std::vector<Vec4<Real>>& positions,
                                      std::vector<Vec3<Real>>& forces) const {
    if constexpr (kIsFloat<Real>) {
        const auto all = groups();
        const bool any_flat_tets = tets_.any_flat();
        for_each_index(0, rows_.nodes.size() / kGroup, kGroupsATask, [&](std::size_t group) {
            find_group_forces(all, group, any_flat_tets, positions, forces);
        });
    } else {
        for_each_index(0, rows_.nodes.size(), kGroup * kGroupsATask, [&](std::size_t row) {
            const std::uint32_t node = rows_.nodes[row];
            if (node == kNoNode || targets[node].w == Real(0)) return;
            forces[node] = terms_of(static_cast<std::uint32_t>(row), positions).force;
        });
    }
}

template <class Real>
template <class Groups>
void StepObjective<Real>::find_group_forces(const Groups& groups, std::size_t group, bool any_flat_tets,
                                            const std::vector<Vec4<Real>>& positions,
                                            std::vector<Vec3<Real>>& forces) const {
    TermColumns terms;
    gather_group(groups, group, positions, terms);
    for (std::uint32_t row = 0; row < kGroup; ++row) {
        const std::uint32_t node = groups.nodes[group * kGroup + row];
        if (node == kNoNode || targets[node].w == Real(0)) continue;
        NodeTerms<Real> all = terms.row(row);
        if (any_flat_tets) add_flat_tets(node, positions, all);
        forces[node] = all.force;
    }
}

template class StepObjective<float>;
template class StepObjective<double>;

}  // namespace gelatin::cpu
