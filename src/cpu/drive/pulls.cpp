#include "cpu/drive/pulls.h"

namespace gelatin::cpu {

template <class Real>
Pulls<Real>::Pulls(const Pull& pull, std::size_t node_count)
    : by_node_(node_count, Vec4<Real>(0)),
      target_(pull.target),
      damping_time_(static_cast<Real>(pull.damping_time)) {
    for (const Pull::Node& held : pull.nodes) {
        nodes_.push_back(held.node);
        by_node_[held.node] = {held.arm, static_cast<Real>(held.stiffness)};
    }
}

template class Pulls<float>;
template class Pulls<double>;

}  // namespace gelatin::cpu
