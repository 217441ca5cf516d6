#pragma once

#include <glm/vec4.hpp>
#include <span>
#include <vector>

#include "gl/program.h"
#include "gpu/node_buffers.h"
#include "model/model.h"

namespace gelatin::gpu {

/// Gives objects that have lost their shape it back: shaders/sim/recovery/count_inverted_tets.comp, and where
/// that finds too many, match_shapes.comp and place_shapes.comp. CPU twin: cpu::ShapeMatcher.
class ShapeMatcher {
public:
    explicit ShapeMatcher(const Model& model);

    /// @param elapsed since the last call [s]
    /// @pre barrier(buffer_update) since the last dispatch
    /// Ends with the barrier that whoever gathers the nodes as textures or storage needs.
    void run(const NodeBuffers& nodes, double elapsed);

    /// How long each object has seemed to be lost [s]; for checkpoints. Blocks until the device has ended.
    /// @pre barrier(buffer_update) since the last run
    std::vector<float> lost_for() const;
    void set_lost_for(std::span<const float> times) { lost_for_.upload(times); }
    const gl::Buffer<float>& lost_for_buffer() const { return lost_for_; }
    /// Nodes were set from outside.
    void forget();

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
    gl::Buffer<float> lost_for_;          // by object [s]
};

}  // namespace gelatin::gpu
