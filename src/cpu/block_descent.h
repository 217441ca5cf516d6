#pragma once

#include <memory>
#include <vector>

#include "cpu/node_terms.h"
#include "cpu/nodes.h"
#include "model/model.h"
#include "model/node_colors.h"
#include "model/node_tets.h"

namespace gelatin::cpu {

/// Vertex block descent (Chen et al. 2024): a step of implicit Euler as the minimum of
///   G(x) = sum_i m_i / (2 h^2) |x_i - y_i|^2 + E(x),   y = x_t + h v_t + h^2 g,
/// found node by node, each by one Newton step on its own three coordinates, all nodes of one colour at once.
/// Between sweeps and after the last one, bodies that nothing holds move as rigid ones to where G is least:
/// that keeps their momentum, which sweeps alone lose (docs/physics.md). Stable for any step and start. The
/// same bits for any number of threads.
template <class Real>
class BlockDescent {
public:
    /// @param iterations sweeps over all nodes in a step
    BlockDescent(std::shared_ptr<const Model> model, int iterations);

    /// A step of `step` seconds from `previous`; writes `current`.
    void run(Real step, const Nodes<Real>& previous, Nodes<Real>& current);

    const NodeColors& colors() const { return colors_; }

private:
    void start(Real step, const Nodes<Real>& previous, std::vector<Vec4<Real>>& positions);
    void mark_nodes_of_flat_tets(const std::vector<Vec4<Real>>& positions);
    void sweep(Real step, const Nodes<Real>& previous, std::vector<Vec4<Real>>& positions);
    void move_node(std::uint32_t node, Real step, const Nodes<Real>& previous,
                   std::vector<Vec4<Real>>& positions);
    void add_neo_hookean_tets(std::uint32_t node, Real step, const Nodes<Real>& previous,
                              const std::vector<Vec4<Real>>& positions, NodeTerms<Real>& terms) const;
    Vec3<Real> outside_colliders(std::uint32_t node, const Vec3<Real>& start, Vec3<Real> position);
    void move_bodies(std::vector<Vec4<Real>>& positions) const;
    void finish(Real step, const Nodes<Real>& previous, Nodes<Real>& current) const;

    std::shared_ptr<const Model> model_;
    int iterations_;
    NodeColors colors_;
    NodeTets node_tets_;
    std::vector<bool> is_pinned_;          // by object: somewhere
    std::vector<Vec3<Real>> targets_;      // y [m], shape [nodes]
    std::vector<std::uint8_t> near_flat_;  // nodes of tets that resist
    std::vector<std::uint8_t> touches_;    // nodes that met a collider in this step
};

}  // namespace gelatin::cpu
