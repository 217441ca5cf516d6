#include "gpu/collision/tree_buffers.h"

namespace gelatin::gpu {
namespace {

std::vector<std::uint32_t> joined(const std::vector<std::vector<std::uint32_t>>& levels) {
    std::vector<std::uint32_t> all;
    for (const std::vector<std::uint32_t>& level : levels) all.insert(all.end(), level.begin(), level.end());
    return all;
}

std::vector<std::uint32_t> starts_of(const std::vector<std::vector<std::uint32_t>>& levels) {
    std::vector<std::uint32_t> starts{0};
    for (const std::vector<std::uint32_t>& level : levels)
        starts.push_back(starts.back() + static_cast<std::uint32_t>(level.size()));
    return starts;
}

}  // namespace

TreeBuffers::TreeBuffers(const BoxTree& trees)
    : nodes(std::span(trees.nodes)),
      boxes(trees.nodes.size()),
      roots(std::span(trees.roots)),
      level_nodes(std::span<const std::uint32_t>(joined(trees.levels))),
      level_starts(starts_of(trees.levels)),
      node_texels(nodes, gl::TexelFormat::rgba32ui),
      box_texels(boxes, gl::TexelFormat::rgba32f),
      root_texels(roots, gl::TexelFormat::r32ui) {}

void TreeBuffers::bind(const gl::Program& program) const {
    program.bind("tree_nodes", node_texels);
    program.bind("tree_boxes", box_texels);
    program.bind("roots", root_texels);
}

}  // namespace gelatin::gpu
