#pragma once

#include <vector>

#include "gl/program.h"
#include "gl/readback.h"
#include "gpu/model_buffers.h"
#include "gpu/node_buffers.h"
#include "model/solver.h"

namespace gelatin::gpu {

/// Sums over each object without stalling the GPU: shaders/sim/measure_nodes.comp and measure_faces.comp make
/// partial sums that come back through a fence; the host adds them up in double precision.
class Measure {
public:
    explicit Measure(const Model& model);

    void begin(const ModelBuffers& model, const NodeBuffers& nodes);
    /// The oldest that is under way; waits for it if need be.
    std::vector<ObjectMeasure> end();

private:
    gl::Program node_program_, face_program_;
    std::vector<Chunk> node_chunks_, face_chunks_;
    gl::Buffer<Chunk> node_chunk_buffer_, face_chunk_buffer_;
    gl::Buffer<Face> faces_;
    gl::Buffer<NodeSums> node_sums_;
    gl::Buffer<float> volumes_;
    gl::Readback readback_;
    std::size_t object_count_;
};

}  // namespace gelatin::gpu
