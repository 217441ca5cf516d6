#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec4.hpp>
#include <vector>

#include "gl/buffer.h"
#include "gl/program.h"
#include "gpu/node_buffers.h"
#include "model/descent/coarse_basis.h"
#include "model/descent/coarse_matrix.h"
#include "model/model.h"

namespace gelatin::gpu {

/// The coarse level of block descent (model/descent/coarse_basis.h):
/// shaders/sim/descent/rotate_clusters.comp, load_clusters.comp, move_clusters.comp, find_displacements.comp,
/// apply_displacements.comp. CPU twin: cpu::CoarseCorrection.
class CoarseCorrection {
public:
    /// @pre basis, of the model, has clusters
    CoarseCorrection(const Model& model, const CoarseBasis& basis);

    /// Looks how clusters are turned. Once a step of `step` seconds, before the rest.
    void begin(const NodeBuffers& nodes, double step);

    /// For descend.comp with FORCES. @param is_ahead for those at the ways' ends
    void bind_forces(const gl::Program& program, bool is_ahead) const;
    const gl::BufferTexture& ahead_texels() const { return ahead_texels_; }

    /// From the forces here: where nodes go.
    void find_ways() const;
    /// From those ahead too: how far. Moves the nodes of begin(); ends with the barrier for whoever gathers
    /// them. @param chunks of nodes @param chunk_starts of each object in them, and the end
    void follow_ways(const gl::Buffer<Chunk>& chunks, const gl::TexelTable<std::uint32_t>& chunk_starts);

private:
    void bind_buffers() const;

    gl::Program turn_program_, load_program_, move_program_, way_program_, sum_program_, factor_program_,
        follow_program_;
    std::uint32_t node_count_, cluster_count_, object_count_;
    std::vector<CoarseMatrices> matrices_;
    double step_ = 0.0;  // that inverses_ are of
    gl::Buffer<ClusterRest> rests_;
    gl::Buffer<Cluster> clusters_;
    gl::Buffer<CoarseBody> bodies_;
    gl::TexelTable<std::uint32_t> core_nodes_, cluster_starts_, node_starts_;
    gl::TexelTable<glm::uvec2> cluster_parts_, node_parts_;  // index, weight
    gl::TexelTable<glm::vec4> rest_positions_;
    gl::Buffer<glm::vec4> forces_, forces_ahead_, ways_, ahead_, sums_;
    gl::BufferTexture ahead_texels_;
    gl::Buffer<float> loads_, inverses_, factors_;
};

}  // namespace gelatin::gpu
