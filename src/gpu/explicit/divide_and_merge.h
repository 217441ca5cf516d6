#pragma once

#include "gpu/explicit/integration.h"

namespace gelatin::gpu {

/// The paper's method (3.3): springs write forces, nodes add them up, nodes move; three kernels,
/// shaders/sim/explicit/write_spring_forces.comp, merge_spring_forces.comp, integrate_nodes.comp, all on
/// storage buffers as in the paper.
class DivideAndMerge {
public:
    DivideAndMerge(const Model& model, const ExplicitScheme& scheme);

    /// Ends with the barrier for the next pass, and for gathering the nodes as textures.
    void run(const ModelBuffers& model, const Pass& pass) const;

    void write_spring_forces(const NodeBuffers& nodes) const;
    void merge_spring_forces() const;

    const gl::Buffer<glm::vec4>& node_forces() const { return node_forces_; }

private:
    gl::Program write_program_, merge_program_, integrate_program_;
    gl::Buffer<Spring> springs_;
    gl::Buffer<std::uint32_t> starts_, entries_;
    gl::Buffer<glm::vec4> spring_forces_, node_forces_;  // [N]
    std::uint32_t node_count_;
};

}  // namespace gelatin::gpu
