#include "gpu/depth/cull_by_depth.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <bit>
#include <numeric>
#include <string>

#include "gl/debug.h"
#include "gl/draw_state.h"

namespace gelatin::gpu {
namespace {

constexpr int kResolution = 256;  // [pixels a side]

gl::Program make_pass(const char* fragment_file) {
    return gl::Program::graphics_with_geometry("sim/depth/draw_face.vert", "sim/depth/face_footprint.geom",
                                               fragment_file);
}

gl::Defines view_defines() {
    return {"VIEW_COUNT " + std::to_string(CullByDepth::kViews)};
}

gl::Buffer<std::uint32_t> count_up(std::size_t size) {
    std::vector<std::uint32_t> numbers(size);
    std::iota(numbers.begin(), numbers.end(), 0u);
    return gl::Buffer<std::uint32_t>(std::span<const std::uint32_t>(numbers));
}

}  // namespace

CullByDepth::CullByDepth(const Model& model)
    : face_views(model.faces.size()),
      object_views(model.objects.size()),
      begin_program_(gl::Program::compute("sim/depth/begin_views.comp", view_defines())),
      nearest_program_(make_pass("sim/depth/nearest_surface.frag")),
      other_program_(make_pass("sim/depth/nearest_other_surface.frag")),
      hidden_program_(make_pass("sim/depth/find_hidden_faces.frag")),
      layers_(kResolution),
      all_faces_(count_up(model.faces.size())),
      hidden_faces_{gl::Buffer<std::uint32_t>(model.faces.size()),
                    gl::Buffer<std::uint32_t>(model.faces.size())},
      draws_(kViews + 1),
      view_space_(2),
      face_view_texels_(face_views, gl::TexelFormat::r32ui),
      object_view_texels_(object_views, gl::TexelFormat::r32ui),
      all_face_texels_(all_faces_, gl::TexelFormat::r32ui),
      hidden_face_texels_{{hidden_faces_[0], gl::TexelFormat::r32ui},
                          {hidden_faces_[1], gl::TexelFormat::r32ui}},
      view_space_texels_(view_space_, gl::TexelFormat::rgba32f) {
    glGenVertexArrays(1, &vertex_array_);
}

CullByDepth::~CullByDepth() {
    glDeleteVertexArrays(1, &vertex_array_);
}

gl::Program CullByDepth::compile(const std::string& file) const {
    return gl::Program::compute("sim/depth/" + file, view_defines());
}

void CullByDepth::bind(const gl::Program& program) const {
    program.bind("face_views", face_view_texels_);
    program.bind("object_views", object_view_texels_);
}

void CullByDepth::run(const ModelBuffers& model, const CollisionBuffers& collision,
                      const NodeBuffers& nodes) {
    begin(collision);
    const gl::DrawStateGuard guard;
    glViewport(0, 0, kResolution, kResolution);
    glBindVertexArray(vertex_array_);
    for (const gl::Program* program : {&nearest_program_, &other_program_, &hidden_program_}) {
        program->bind("positions", nodes.position_texels);
        program->bind("faces", model.face_texels);
        program->bind("view_space", view_space_texels_);
    }
    layers_.bind_nearest_object(other_program_);
    layers_.bind_all(hidden_program_);
    hidden_program_.bind("FaceViews", face_views);
    hidden_program_.bind("ObjectViews", object_views);
    hidden_program_.bind("Draws", draws_);
    for (unsigned view = 0; view < kViews; ++view) draw_view(view);
    gl::check_errors("culling by depth");
}

void CullByDepth::begin(const CollisionBuffers& collision) const {
    const auto faces = static_cast<std::uint32_t>(face_views.size());
    begin_program_.bind("BoundingBoxes", collision.bounding_boxes);
    begin_program_.bind("FaceViews", face_views);
    begin_program_.bind("ObjectViews", object_views);
    begin_program_.bind("Draws", draws_);
    begin_program_.bind("ViewSpace", view_space_);
    begin_program_.set("face_count", faces);
    begin_program_.set("object_count", collision.object_count);
    begin_program_.dispatch(std::max({faces, collision.object_count, kViews + 1}));
    gl::barrier(gl::Barrier::storage | gl::Barrier::texture_fetch | gl::Barrier::command);
}

void CullByDepth::draw_view(unsigned view) const {
    for (const gl::Program* program : {&nearest_program_, &other_program_, &hidden_program_})
        program->bind("drawn_faces", view == 0 ? all_face_texels_ : hidden_face_texels_[(view - 1) % 2]);
    hidden_program_.bind("HiddenFaces", hidden_faces_[view % 2]);
    glEnable(GL_DEPTH_TEST);
    layers_.begin_nearest();
    draw_faces(nearest_program_, view);
    layers_.begin_nearest_other();
    draw_faces(other_program_, view);
    glDisable(GL_DEPTH_TEST);
    layers_.begin_comparison();
    hidden_program_.set("view", view + 1);
    gl::barrier(gl::Barrier::storage);  // the next view's arguments are beside those that were just read
    draw_faces(hidden_program_, view);
    gl::barrier(gl::Barrier::storage | gl::Barrier::texture_fetch | gl::Barrier::command);
}

void CullByDepth::draw_faces(const gl::Program& program, unsigned view) const {
    program.set("axis", view % 3);
    program.set("from_behind", view / 3);
    program.set("resolution", static_cast<float>(kResolution));
    program.draw_arrays_indirect(gl::Primitive::points, draws_.id(), view * sizeof(Draw));
}

}  // namespace gelatin::gpu
