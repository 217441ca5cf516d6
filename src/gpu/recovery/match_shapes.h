#pragma once

#include <glm/vec4.hpp>

#include "gl/program.h"
#include "gpu/node_buffers.h"
#include "model/model.h"

namespace gelatin::gpu {

/// Gives objects that have lost their shape it back: shaders/sim/recovery/count_inverted_tets.comp, and where
/// that finds too many, match_shapes.comp and place_shapes.comp. CPU twin: cpu::ShapeMatcher.
class ShapeMatcher {
public:
    explicit ShapeMatcher(const Model& model);

    /// @pre barrier(buffer_update) since the last dispatch
    /// Ends with the barrier that whoever gathers the nodes as textures or storage needs.
    void run(const NodeBuffers& nodes);

private:
    gl::Program count_program_, sum_program_, match_program_, place_program_;
    std::uint32_t node_count_, tet_count_, object_count_;
    gl::TexelTable<glm::uvec4> tets_;
    gl::TexelTable<glm::vec4> tet_rests_;  // volume [m^3]
    gl::TexelTable<glm::vec4>
        rest_offsets_;  // from the object's centre of mass [m], mass [kg], shape [nodes]
    gl::TexelTable<std::uint32_t> node_objects_, chunk_starts_;  // by object
    gl::Buffer<RestMoment> rest_moments_;
    gl::Buffer<Chunk> chunks_;
    gl::Buffer<std::uint32_t> inverted_;  // see shaders/sim/recovery/inverted_tets.glsl
    gl::Buffer<ShapeSums> sums_;          // by chunk
    gl::Buffer<ShapePlace> places_;       // by object
};

}  // namespace gelatin::gpu
