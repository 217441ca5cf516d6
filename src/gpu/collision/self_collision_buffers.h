#pragma once

#include <glm/vec4.hpp>

#include "gl/buffer.h"
#include "gl/program.h"
#include "model/model.h"

namespace gelatin::gpu {

/// The buffers that the stages of self-collision pass to one another, in addition to CollisionBuffers.
struct SelfCollisionBuffers {
    gl::Buffer<glm::vec4> rest_offsets;  ///< RestShapes::offsets
    gl::Buffer<float> clearances;        ///< RestShapes::clearances
    gl::BufferTexture rest_offset_texels, clearance_texels;
    gl::Buffer<AffineFit> fits;  ///< the last one that was made, shape [objects]
    gl::BufferTexture fit_texels;
    gl::Buffer<std::uint32_t> last_restless;  ///< number of the step, shape [objects]
    gl::Buffer<std::uint32_t> restless;       ///< faces that are not calm
    gl::Buffer<std::uint32_t> is_calm;        ///< 1 if the object is restless, else 0, shape [faces]
    gl::Buffer<std::uint32_t>
        contact_counts;  ///< number of faces of its own object that each touches, shape [faces]
    gl::Buffer<std::uint32_t> colliding;  ///< faces that touch any
    std::uint32_t face_count = 0;

    /// @pre the model has rest shapes
    explicit SelfCollisionBuffers(const Model& model);
};

/// For shaders that read the faces' contacts with their own object if there can be any.
gl::Defines self_collision_defines(const Model& model);

}  // namespace gelatin::gpu
