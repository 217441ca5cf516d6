#pragma once

#include <span>
#include <vector>

#include "cpu/collision/axis_box.h"
#include "cpu/collision/walk_tree.h"
#include "model/model.h"

namespace gelatin::cpu {

/// Finds the boxes that meet a box, among the bounding boxes of all objects. The tree over them keeps its
/// topology. The order of the objects in it is renewed from time to time, because objects move about. GPU
/// twin: gpu::ObjectTree.
template <class Real>
class ObjectTree {
public:
    explicit ObjectTree(std::uint32_t object_count);

    /// Sets the objects' boxes, which must exist as long as they are searched.
    void update(std::span<const AxisBox<Real>> boxes);

    /// found(object) for each whose box meets `box`, in no particular order.
    template <class Found>
    void for_objects_near(const AxisBox<Real>& box, const Found& found) const {
        for_items_near<Real>(tree_, node_boxes_, 0, box, [&](std::uint32_t place) {
            if (meet(box, boxes_[order_[place]])) found(order_[place]);
        });
    }

private:
    void renew_order();

    BoxTree tree_;
    std::vector<std::uint32_t> order_;       // of the objects in the tree
    std::vector<AxisBox<Real>> node_boxes_;  // shape [nodes of the tree]
    std::span<const AxisBox<Real>> boxes_;
    int age_ = 0;  // age of the order, in updates
};

}  // namespace gelatin::cpu
