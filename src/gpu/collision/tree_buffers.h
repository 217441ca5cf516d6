#pragma once

#include <vector>

#include "gl/buffer.h"
#include "gl/program.h"
#include "model/model.h"

namespace gelatin::gpu {

/// Trees of boxes on the GPU.
struct TreeBuffers {
    gl::Buffer<TreeNode> nodes;
    gl::Buffer<Box> boxes;                    ///< shape [nodes]
    gl::Buffer<std::uint32_t> roots;          ///< of each tree
    gl::Buffer<std::uint32_t> level_nodes;    ///< nodes by height, leaves first
    std::vector<std::uint32_t> level_starts;  ///< in level_nodes, and the end
    gl::BufferTexture node_texels, box_texels, root_texels;

    explicit TreeBuffers(const BoxTree& trees);

    /// For programs that walk through them.
    void bind(const gl::Program& program) const;

    std::size_t level_count() const { return level_starts.size() - 1; }
};

}  // namespace gelatin::gpu
