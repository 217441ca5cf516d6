#pragma once

#include <cstdint>
#include <memory>
#include <span>
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
    explicit GluedNodes(std::shared_ptr<const Model> model);

    /// @param inertia 0 for held nodes
    void find(std::span<const ContactRow<Real>> rows, std::span<const Real> inertia);
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
