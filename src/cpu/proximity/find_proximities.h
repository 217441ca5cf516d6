#pragma once

#include <memory>
#include <span>
#include <vector>

#include "cpu/collision/collision.h"
#include "cpu/proximity/proximity.h"
#include "model/model.h"
#include "model/solver.h"

namespace gelatin::cpu {

/// Finds proximities: for each surface node the faces, and for each surface edge the edges, that are nearer
/// than a radius, in the objects that may touch and, with `own`, in the same object. Faces that have the
/// node, and edges that share a node, are excluded (docs/collision.md). The same result, in the same order,
/// for any number of threads. GPU twin: gpu::FindProximities.
template <class Real>
class FindProximities {
public:
    /// @param collision must outlive this; its boxes have the margin for `radius` [m]
    FindProximities(std::shared_ptr<const Model> model, const Collision<Real>& collision, double radius,
                    bool own);

    /// @pre the boxes and pairs of objects are those of `positions`
    void run(std::span<const Vec4<Real>> positions);

    /// All results: nodes and faces, then edges. Those of query q, node q of SurfaceParts::nodes or edge q -
    /// nodes, are starts()[q] .. starts()[q + 1], in ascending order of `second`.
    const std::vector<Proximity<Real>>& proximities() const { return proximities_; }
    const std::vector<std::uint32_t>& starts() const { return starts_; }  ///< shape [nodes + edges + 1]
    ProximityMeasure measure() const;

private:
    // A face or an edge, and its box.
    struct Near {
        std::uint32_t index;
        AxisBox<Real> box;
    };
    // The results of the nodes and edges of a few leaves.
    struct Found {
        std::vector<Near> faces, edges;  // near the current leaf, ascending
        std::vector<Proximity<Real>> node_face, edge_edge;
    };
    void search(std::uint32_t leaf, std::span<const Vec4<Real>> positions, Found& found);
    void find_near(std::uint32_t leaf, Found& found) const;
    void walk(std::uint32_t leaf, std::uint32_t object, Found& found) const;
    void test_node(std::uint32_t place, std::span<const Vec4<Real>> positions, Found& found);
    void test_edge(std::uint32_t edge, std::span<const Vec4<Real>> positions, Found& found);
    void collect();

    std::shared_ptr<const Model> model_;
    const Collision<Real>& collision_;
    BoxMargin<Real> margin_;
    Real squared_radius_;  // [m^2]
    bool own_;
    std::vector<AxisBox<Real>> edge_boxes_;  // shape [edges]
    std::vector<Found> found_;               // in the leaves' order, kLeavesATask in each
    std::vector<std::uint32_t> starts_;      // counts, until they are summed
    std::vector<Proximity<Real>> proximities_;
};

}  // namespace gelatin::cpu
