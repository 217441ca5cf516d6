#pragma once

#include <glm/vec4.hpp>

#include "gpu/collision/face_filter.h"
#include "gpu/depth/depth_layers.h"
#include "gpu/node_buffers.h"

namespace gelatin::gpu {

/// Finds the faces that may touch another object, the potentially colliding set, by drawing all faces.
///
/// A face that is completely in front of all surfaces of other objects, seen from some direction, touches
/// none of them (Govindaraju, Redon, Lin, Manocha: CULLIDE, Graphics Hardware 2003). There are six views,
/// along the axes and back. Each draws what was hidden in all previous ones, so that they remove layer after
/// layer. A view draws three times, however many objects there are: shaders/sim/depth/nearest_surface.frag,
/// nearest_other_surface.frag and find_hidden_faces.frag, each over the pixels that a face touches according
/// to face_footprint.geom.
class CullByDepth : public FaceFilter {
public:
    static constexpr std::uint32_t kViews = 6;

    explicit CullByDepth(const Model& model);
    CullByDepth(const CullByDepth&) = delete;
    CullByDepth& operator=(const CullByDepth&) = delete;
    ~CullByDepth() override;

    /// Writes face_views and object_views. Restores the drawing state of an application, except the bound
    /// textures, buffers and programs.
    void run(const ModelBuffers& model, const CollisionBuffers& collision, const NodeBuffers& nodes) override;

    gl::Program compile(const std::string& file) const override;
    void bind(const gl::Program& program) const override;

    /// The last view in which each face, and any face of each object, was hidden, from 1; 0: none.
    gl::Buffer<std::uint32_t> face_views, object_views;

private:
    void begin(const CollisionBuffers& collision) const;
    void draw_view(unsigned view) const;
    void draw_faces(const gl::Program& program, unsigned view) const;

    gl::Program begin_program_, nearest_program_, other_program_, hidden_program_;
    DepthLayers layers_;
    gl::Buffer<std::uint32_t> all_faces_, hidden_faces_[2];  // views read one of them and write another
    gl::Buffer<Draw> draws_;            // what each view draws, and what the last one keeps
    gl::Buffer<glm::vec4> view_space_;  // lower corner [m] and scale [1/m] of the view's box
    gl::BufferTexture face_view_texels_, object_view_texels_, all_face_texels_, hidden_face_texels_[2],
        view_space_texels_;
    unsigned vertex_array_ = 0;  // empty, as drawing needs one
};

}  // namespace gelatin::gpu
