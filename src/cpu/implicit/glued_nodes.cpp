#include "cpu/implicit/glued_nodes.h"

#include <algorithm>
#include <utility>

namespace gelatin::cpu {

template <class Real>
GluedNodes<Real>::GluedNodes(std::shared_ptr<const Model> model) : model_(std::move(model)) {}

template <class Real>
void GluedNodes<Real>::find(std::span<const ContactRow<Real>> rows, std::span<const Real> inertia) {
    nodes_.clear();
    if (std::none_of(rows.begin(), rows.end(), [](const ContactRow<Real>& row) { return row.is_tie(); }))
        return;
    nodes_.resize(rows.size(), kNoNode);
    rows_.assign(model_->node_count(), kNoNode);
    leads_.assign(model_->node_count(), 0);
    for (std::uint32_t r = 0; r < rows.size(); ++r) {
        const ContactRow<Real>& row = rows[r];
        const Range& own = model_->objects[row.other].nodes;
        const std::uint32_t node = row.nodes[0];
        const std::span leaders = std::span(row.nodes).subspan(1, row.count - 1);
        const bool is_glue = row.is_point() && !leaders.empty() &&
                             std::none_of(leaders.begin(), leaders.end(),
                                          [&](std::uint32_t n) { return n >= own.first && n < own.end(); });
        const auto is_glued = [&](std::uint32_t n) { return rows_[n] != kNoNode; };
        if (!is_glue || model_->objects[row.other].is_rigid || inertia[node] == Real(0) ||
            leads_[node] != 0 || is_glued(node) || std::any_of(leaders.begin(), leaders.end(), is_glued))
            continue;
        rows_[node] = r;
        nodes_[r] = node;
        for (const std::uint32_t n : leaders) leads_[n] = 1;
    }
}

template class GluedNodes<float>;
template class GluedNodes<double>;

}  // namespace gelatin::cpu
