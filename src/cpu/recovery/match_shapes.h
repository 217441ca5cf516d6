#pragma once

#include <algorithm>
#include <memory>
#include <vector>

#include "core/archive.h"
#include "cpu/nodes.h"
#include "model/model.h"
#include "model/recovery/match_shapes.h"

namespace gelatin::cpu {

/// Objects that have lost their shape, as those whose nodes are in random places have, get it back, as shape
/// matching does it (M. Mueller, B. Heidelberger, M. Teschner, M. Gross: Meshless Deformations Based on Shape
/// Matching, ACM Transactions on Graphics 24(3), 2005): the shape at rest is put where it comes nearest to
/// the nodes, and moves as a rigid body with the momentum and angular momentum that they have. Steps alone
/// end such a body in a tangle now and then, a minimum of its energy. GPU twin: gpu::ShapeMatcher.
template <class Real>
class ShapeMatcher {
public:
    explicit ShapeMatcher(std::shared_ptr<const Model> model);

    /// @param elapsed since the last call [s] @return the bodies that were put elsewhere, ascending
    std::vector<std::uint32_t> run(Nodes<Real>& nodes, double elapsed);
    /// Nodes were set from outside.
    void forget() { std::fill(lost_for_.begin(), lost_for_.end(), static_cast<float>(kPatience)); }
    void archive(Archive& archive) { archive.array(lost_for_); }

private:
    void count_inverted_tets(const std::vector<Vec4<Real>>& positions);
    bool match(std::uint32_t object, Nodes<Real>& nodes, float elapsed);

    std::shared_ptr<const Model> model_;
    MatchShapes shapes_;
    std::vector<std::uint32_t> inverted_;  // tets, by object
    std::vector<float> lost_for_;          // how long bodies have seemed to be lost [s]
};

}  // namespace gelatin::cpu
