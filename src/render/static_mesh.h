#pragma once

#include <cstdint>
#include <glm/vec4.hpp>
#include <vector>

#include "gelatin/views.h"
#include "gl/buffer.h"
#include "mesh/surface_mesh.h"
#include "render/camera.h"

namespace gelatin::render {

/// A surface that does not move, in its own buffers, in the same format as bodies. Edges where faces meet at
/// more than 40 degrees are sharp, all others smooth. Move-only; needs the context in which it was made.
class StaticMesh {
public:
    StaticMesh() = default;
    /// One object for each surface, in order.
    explicit StaticMesh(const std::vector<SurfaceMesh>& surfaces);

    /// Valid as long as this lives.
    RenderView view() const;

private:
    gl::Buffer<glm::vec4> positions_;
    gl::Buffer<glm::uvec4> vertices_;
    gl::Buffer<glm::vec4> normals_;
    gl::Buffer<std::uint32_t> triangles_;
    std::uint32_t object_count_ = 0;
    Bounds bounds_;  // [m]
};

}  // namespace gelatin::render
