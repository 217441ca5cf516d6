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
void StepObjective<Real>::begin(Real seconds, const Contacts<Real>* contacts) {
    contacts_ = contacts;
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
void StepObjective<Real>::add_rare_terms(std::size_t group, bool any_flat, const Contacts<Real>* contacts,
                                         const std::vector<Vec4<Real>>& positions, Terms& terms) const {
    for (std::uint32_t r = 0; r < kGroup; ++r) {
        const std::uint32_t node = rows_.nodes[group * kGroup + r];
        if (node == kNoNode) continue;
        const bool presses = contacts != nullptr && contacts->presses(node);
        if (!any_flat && !presses) continue;
        NodeTerms<Real> sum;
        if (any_flat) flat_tets_.add(node, positions, sum);
        if (presses) contacts->add(node, Vec3<Real>(positions[node]), sum);
        terms.add(r, sum);
    }
}

template <class Real>
typename StepObjective<Real>::Terms StepObjective<Real>::gather_forces(
    std::size_t group, bool any_flat, const Contacts<Real>* contacts,
    const std::vector<Vec4<Real>>& positions) const {
    Terms terms;
    if (any_flat || contacts != nullptr) add_rare_terms(group, any_flat, contacts, positions, terms);
    elements_.add_forces(rows_, step, group, positions, terms);
    return terms;
}

template <class Real>
std::uint32_t StepObjective<Real>::descend(std::size_t group, bool any_flat,
                                           std::vector<Vec4<Real>>& positions, Terms& terms) const {
    if (any_flat || contacts_ != nullptr) add_rare_terms(group, any_flat, contacts_, positions, terms);
    return elements_.descend(rows_, step, group, positions, terms);
}

template <class Real>
void StepObjective<Real>::find_forces(const std::vector<Vec4<Real>>& positions,
                                      const Contacts<Real>* contacts, std::vector<Vec3<Real>>& forces,
                                      std::span<const std::uint8_t> wanted) const {
    find_forces({0, static_cast<std::uint32_t>(group_count())}, any_flat_tets(), positions, contacts, forces,
                wanted);
}

template <class Real>
void StepObjective<Real>::find_forces(std::size_t batch, const std::vector<Vec4<Real>>& positions,
                                      std::vector<Vec3<Real>>& forces,
                                      std::span<const std::uint8_t> wanted) const {
    for (const Range& color : rows_.batches[batch].colors)
        find_forces({color.first / kGroup, color.count / kGroup}, any_flat_tets(batch), positions, nullptr,
                    forces, wanted);
}

template <class Real>
void StepObjective<Real>::find_forces(const Range& groups, bool any_flat,
                                      const std::vector<Vec4<Real>>& positions,
                                      const Contacts<Real>* contacts, std::vector<Vec3<Real>>& forces,
                                      std::span<const std::uint8_t> wanted) const {
    const auto is_wanted = [&](std::size_t row) {
        return rows_.nodes[row] != kNoNode && (wanted.empty() || wanted[rows_.nodes[row]] != 0);
    };
    for_each_index(groups.first, groups.end(), kGroupsATask, [&](std::size_t group) {
        bool any_wanted = false;
        for (std::uint32_t r = 0; r < kGroup; ++r) any_wanted |= is_wanted(group * kGroup + r);
        if (!any_wanted) return;
        const Terms terms = gather_forces(group, any_flat, contacts, positions);
        for (std::uint32_t r = 0; r < kGroup; ++r) {
            const std::uint32_t node = rows_.nodes[group * kGroup + r];
            if (node != kNoNode && step.targets[node].w != Real(0)) forces[node] = terms.row(r).force;
        }
    });
}

template <class Real>
void StepObjective<Real>::find_held_forces(const std::vector<Vec4<Real>>& positions,
                                           std::vector<Vec3<Real>>& forces) const {
    const bool any_flat = any_flat_tets();
    for_each_index(0, group_count(), kGroupsATask, [&](std::size_t group) {
        const std::size_t first = group * kGroup;
        bool any_held = false;
        for (std::size_t r = 0; r < kGroup; ++r) any_held |= is_held(first + r);
        if (!any_held) return;
        const Terms terms = gather_forces(group, any_flat, nullptr, positions);
        for (std::size_t r = 0; r < kGroup; ++r)
            if (is_held(first + r)) forces[rows_.nodes[first + r]] = terms.row(r).force;
    });
}

template class StepObjective<float>;
template class StepObjective<double>;

}  // namespace gelatin::cpu
