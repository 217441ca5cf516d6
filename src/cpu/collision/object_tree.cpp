#include "cpu/collision/object_tree.h"

#include "model/collision/box_tree.h"

namespace gelatin::cpu {

template <class Real>
ObjectTree<Real>::ObjectTree(std::uint32_t object_count) : order_(object_count) {
    append_box_tree({0, object_count}, tree_);
    node_boxes_.resize(tree_.nodes.size());
}

template <class Real>
void ObjectTree<Real>::update(std::span<const AxisBox<Real>> boxes) {
    boxes_ = boxes;
    if (age_ == 0) renew_order();
    age_ = (age_ + 1) % kOrderLifetime;
    for (auto n = static_cast<std::uint32_t>(tree_.nodes.size()); n-- > 0;) {
        const TreeNode& node = tree_.nodes[n];
        AxisBox<Real> box;
        for (std::uint32_t k = node.first_item; k < node.first_item + node.item_count; ++k)
            box.add(boxes_[order_[k]]);
        for (std::uint32_t child = n + 1; child < node.skip; child = tree_.nodes[child].skip)
            box.add(node_boxes_[child]);
        node_boxes_[n] = box;
    }
}

template <class Real>
void ObjectTree<Real>::renew_order() {
    std::vector<glm::dvec3> centers;
    for (const AxisBox<Real>& box : boxes_) centers.emplace_back(box.center());
    order_ = box_tree_order(centers);
}

template class ObjectTree<float>;
template class ObjectTree<double>;

}  // namespace gelatin::cpu
