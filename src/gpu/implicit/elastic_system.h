#pragma once

#include <glm/vec2.hpp>
#include <glm/vec4.hpp>
#include <optional>

#include "gl/buffer.h"
#include "gl/program.h"
#include "gpu/elasticity/find_volume_stresses.h"
#include "gpu/implicit/tries.h"
#include "gpu/model_buffers.h"
#include "gpu/node_buffers.h"
#include "model/model.h"

namespace gelatin::gpu {

/// The elements of a step, linearised where it begins: springs, tets and the volume term, with their dampers.
/// For a displacement d of the nodes, forces are f - K d. K is a matrix an edge (ElementEdges), all sums are
/// gathered in a fixed order: shaders/sim/implicit/linearise_tets.comp, linearise_edges.comp,
/// linearise_nodes.comp, multiply.comp. CPU twin: cpu::ElasticSystem.
class ElasticSystem {
public:
    explicit ElasticSystem(const Model& model);

    /// Ends with the barrier for whoever reads what is found.
    /// @param at where a part of a step begins @param damping_times of nodes [s], a texel each
    /// @param tries the clock has the step of the part, which is made
    void linearise(const ModelBuffers& model, const NodeBuffers& at, const gl::BufferTexture& damping_times,
                   Tries& tries) const;

    /// f [N], xyz, and the blocks of K on its diagonal, shape [nodes]; of held nodes, too.
    const gl::Buffer<glm::vec4>& forces() const { return forces_; }
    const gl::Buffer<NodeBlock>& blocks() const { return blocks_; }
    const gl::BufferTexture& block_texels() const { return block_texels_; }

    gl::Buffer<glm::vec4> displacements;  ///< d [m], xyz, shape [nodes]
    const gl::BufferTexture& displacement_texels() const { return displacement_texels_; }
    /// @param products output: K d [N], xyz, shape [nodes]; who reads them needs a barrier
    void multiply(const gl::Buffer<glm::vec4>& products) const;
    /// For programs that define PRODUCTS and include sim/implicit/half_edges.glsl. @param d what they
    /// multiply
    void bind_product(const gl::Program& program, const gl::BufferTexture& d) const;
    /// The same, of which FIELD_AT is what they multiply.
    void bind_edges(const gl::Program& program) const;
    /// For programs that include sim/implicit/tets.glsl.
    void bind_tets(const gl::Program& program) const;

private:
    void bind_buffers() const;

    gl::Program tet_program_, edge_program_, node_program_, product_program_;
    std::uint32_t node_count_, tet_count_, edge_count_;
    std::optional<FindVolumeStresses> stresses_;  // if the model has a volume term
    gl::TexelTable<glm::uvec4> tets_;
    gl::TexelTable<glm::vec4> tet_rests_, neo_hookean_tets_;
    gl::TexelTable<std::uint32_t> neo_hookean_numbers_;
    gl::TexelTable<std::uint32_t> node_tets_, node_tet_starts_, edge_tets_, edge_tet_starts_,
        half_edge_starts_;
    gl::TexelTable<glm::uvec2> half_edges_;
    gl::Buffer<ElementEdge> edges_;
    gl::Buffer<glm::vec4> tet_rows_, forces_;
    gl::Buffer<EdgeMatrix> matrices_;
    gl::Buffer<NodeBlock> blocks_;
    gl::BufferTexture tet_row_texels_, matrix_texels_, block_texels_, displacement_texels_;
};

}  // namespace gelatin::gpu
