#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "cpu/collision/axis_box.h"
#include "cpu/nodes.h"
#include "model/model.h"

namespace gelatin::cpu {

/// Of bodies of any shape: which leaves of their trees of faces are near each other at the start. While a
/// body hardly deforms only these can meet. For a rotation R of it, its middles C and c at the start and now,
/// and what a node at X that has come to x differs by, u = R^T (x - c) - (X - C), two points are
///   |x - y| >= |X - Y| - |u_x - u_y|
/// apart; while they go straight, and R turns by an angle a meanwhile, at least
///   cos(a / 2) |X - Y| - max |u_x - u_y| of both ends.
template <class Real>
class NearAtRest {
public:
    explicit NearAtRest(std::shared_ptr<const Model> model);

    /// Lists those of a body. @param boxes round the faces at the start, by node of the trees
    void add(std::uint32_t object, std::span<const AxisBox<Real>> boxes);
    /// For a motion in which all nodes go straight. May be called for several bodies at once.
    /// @param within how near pairs come that are wanted [m]
    void begin(std::uint32_t object, std::span<const Vec4<Real>> from, std::span<const Vec4<Real>> to,
               Real within);
    /// Whether no leaves come so near but those that are listed.
    bool is_enough(std::uint32_t object) const { return shapes_[object].is_enough; }
    /// Leaves that may come so near to one of a body, it among them, ascending. @pre is_enough(object)
    void find(std::uint32_t object, std::uint32_t leaf, std::vector<std::uint32_t>& leaves) const;

private:
    struct Near {
        std::uint32_t leaf;
        float gap;  // of the nearest pair, at the start [m]
    };
    struct Shape {
        Real listed = 0;  // up to which gap leaves are listed [m]; 0: none are
        // In the motion:
        bool is_enough = false;
        Real within = 0, cosine = 1;  // [m]; cos(a / 2)
        Real most = 0;                // |u_x - u_y| of any two [m]

        bool are_apart(Real gap, Real change) const { return cosine * gap - change > within; }
    };
    // Of a node and its face, or two edges, with no corner in common, of two leaves of a body.
    float nearest_gap(std::uint32_t object, const TreeNode& leaf, const TreeNode& other) const;

    std::shared_ptr<const Model> model_;
    std::vector<Shape> shapes_;             // by object
    std::vector<std::vector<Near>> near_;   // by node of the trees, by gap
    std::vector<AxisBox<Real>> of_nodes_;   // u at both ends
    std::vector<AxisBox<Real>> of_leaves_;  // by node of the trees
};

}  // namespace gelatin::cpu
