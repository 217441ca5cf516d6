#pragma once

#include <algorithm>
#include <cstdint>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "cpu/implicit/contact_row.h"
#include "cpu/nodes.h"
#include "model/model.h"

namespace gelatin::cpu {

/// Nodes that ties hold at points of other bodies, each by one row: x_a = sum_j c_j x_j + u_a, with j the
/// nodes that carry the point, its leaders, and c_j = -w_j. Ties are so stiff that u_a is small. So
/// preconditioners take u_a in place of x_a for the unknown: then what moves leaders takes along what is
/// glued to them, and the tie resists u_a alone.
///
/// No leader is glued itself. Of ties of points that several nodes carry on both sides, none is.
template <class Real>
class GluedNodes {
public:
    explicit GluedNodes(std::shared_ptr<const Model> model) : model_(std::move(model)) {}

    /// @param inertia 0 for held nodes
    void find(std::span<const ContactRow<Real>> rows, std::span<const Real> inertia) {
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
                                 std::none_of(leaders.begin(), leaders.end(), [&](std::uint32_t n) {
                                     return n >= own.first && n < own.end();
                                 });
            const auto is_glued = [&](std::uint32_t n) { return rows_[n] != kNoNode; };
            if (!is_glue || model_->objects[row.other].is_rigid || inertia[node] == Real(0) ||
                leads_[node] != 0 || is_glued(node) || std::any_of(leaders.begin(), leaders.end(), is_glued))
                continue;
            rows_[node] = r;
            nodes_[r] = node;
            for (const std::uint32_t n : leaders) leads_[n] = 1;
        }
    }
    bool is_empty() const { return nodes_.empty(); }
    /// By which row a node is glued, or kNoNode.
    std::uint32_t row_of(std::uint32_t node) const { return is_empty() ? kNoNode : rows_[node]; }
    /// The node that a row glues, or kNoNode.
    std::uint32_t node_of(std::size_t row) const { return is_empty() ? kNoNode : nodes_[row]; }

private:
    std::shared_ptr<const Model> model_;
    std::vector<std::uint32_t> rows_, nodes_;
    std::vector<std::uint8_t> leads_;  // nodes
};

}  // namespace gelatin::cpu
