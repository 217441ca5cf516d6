#include "gpu/drive/pulls.h"

namespace gelatin::gpu {

Pulls::Pulls(std::size_t node_count)
    : by_node_(node_count, glm::vec4(0.0f)),
      buffer_(std::span<const glm::vec4>(by_node_)),
      texels_(buffer_, gl::TexelFormat::rgba32f) {}

void Pulls::set(const std::optional<Pull>& pull) {
    for (const std::uint32_t n : held_) by_node_[n] = glm::vec4(0.0f);
    held_.clear();
    if (pull) {
        target_ = glm::vec3(pull->target);
        damping_time_ = static_cast<float>(pull->damping_time);
        for (const Pull::Node& held : pull->nodes) {
            held_.push_back(held.node);
            by_node_[held.node] = {held.arm, held.stiffness};
        }
    }
    buffer_.upload(by_node_);
}

void Pulls::bind(const gl::Program& program) const {
    program.bind("pulls", texels_);
    program.set("pull_target", target_);
    program.set("pull_damping_time", damping_time_);
}

}  // namespace gelatin::gpu
