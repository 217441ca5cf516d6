#include "gpu/drive/pulls.h"

#include <algorithm>
#include <utility>

namespace gelatin::gpu {

Pulls::Pulls(std::size_t node_count) : acted_(node_count) {
    allocate(1);
}

void Pulls::allocate(std::size_t node_count) {
    const std::vector<NodeActions> none(node_count);
    buffer_ = gl::Buffer<NodeActions>(std::span<const NodeActions>(none));
    texels_ = gl::BufferTexture(buffer_, gl::TexelFormat::rgba32f);
}

void Pulls::set_pulls(std::vector<Pull> pulls) {
    acted_.set_pulls(std::move(pulls));
    upload();
}

void Pulls::move_pull(std::size_t pull, const glm::dvec3& target) {
    acted_.move_pull(pull, target);
    upload();
}

void Pulls::set_forces(std::span<const glm::vec3> forces) {
    acted_.set_forces(forces);
    upload();
}

// What acted before and does not any more is in the first nodes, too.
void Pulls::upload() {
    const std::span<const NodeActions> by_node = acted_.by_node();
    if (by_node.empty()) return;
    if (buffer_.size() != by_node.size()) allocate(by_node.size());
    const std::size_t end = acted_.nodes().empty() ? 0 : acted_.nodes().back() + std::size_t{1};
    buffer_.upload(by_node.first(std::max(end, uploaded_)));
    uploaded_ = end;
}

void Pulls::bind(const gl::Program& program) const {
    program.bind("pulls", texels_);
    program.set("is_pulled", is_acting() ? 1u : 0u);
}

}  // namespace gelatin::gpu
