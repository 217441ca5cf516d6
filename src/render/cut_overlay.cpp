#include "render/cut_overlay.h"

#include <epoxy/gl.h>

#include <array>

#include "render/legend.h"

namespace gelatin::render {
namespace {

constexpr float kSideWidth = 0.7f;  // of lines [pixels]

gl::BufferTexture positions_of(const RenderView& bodies) {
    return {bodies.overlay.node_positions, std::size_t{16} * bodies.overlay.node_count,
            gl::TexelFormat::rgba32f};
}

gl::BufferTexture tets_of(const CutView& cut) {
    return {cut.tets, std::size_t{16} * cut.tet_count, gl::TexelFormat::rgba32ui};
}

}  // namespace

CutOverlay::CutOverlay()
    : find_program_(gl::Program::compute("render/find_cut_tets.comp")),
      plain_program_(gl::Program::graphics("render/cut_tets.vert", "render/cut_tets.frag")),
      colored_program_(gl::Program::graphics("render/cut_tets.vert", "render/cut_tets.frag", {"COLOR_MAP"})),
      draw_arguments_(4) {}

void CutOverlay::find(const RenderView& bodies) {
    const CutView& cut = *bodies.overlay.cut;
    if (met_tets_.size() < cut.tet_count) met_tets_ = gl::Buffer<std::uint32_t>(cut.tet_count);
    gl::barrier(gl::Barrier::buffer_update | gl::Barrier::storage);  // an earlier picture may still read both
    draw_arguments_.upload(std::array<std::uint32_t, 4>{0, 1, 0, 0});  // vertices, instances, first of both
    const gl::BufferTexture positions = positions_of(bodies), tets = tets_of(cut);
    find_program_.bind("node_positions", positions);
    find_program_.bind("tets", tets);
    find_program_.bind("MetTets", met_tets_);
    find_program_.bind("Arguments", draw_arguments_);
    find_program_.set("tet_count", cut.tet_count);
    find_program_.set("cut_plane", glm::vec4(cut.plane[0], cut.plane[1], cut.plane[2], cut.plane[3]));
    find_program_.dispatch(cut.tet_count);
    gl::barrier(gl::Barrier::texture_fetch | gl::Barrier::command);
}

void CutOverlay::draw(const Frame& frame, const RenderView& bodies) const {
    const CutView& cut = *bodies.overlay.cut;
    const auto& map = bodies.overlay.color_map;
    const gl::BufferTexture positions = positions_of(bodies), tets = tets_of(cut);
    const gl::BufferTexture met_tets(met_tets_, gl::TexelFormat::r32ui);
    const gl::BufferTexture tet_objects(cut.tet_objects, std::size_t{4} * cut.tet_count,
                                        gl::TexelFormat::r32ui);
    gl::BufferTexture tet_values;
    const gl::Program& program = map ? colored_program_ : plain_program_;
    program.bind("node_positions", positions);
    program.bind("tets", tets);
    program.bind("met_tets", met_tets);
    program.bind("object_colors", frame.bodies.colors);
    program.bind("tet_objects", tet_objects);
    if (map) {
        tet_values = {map->tet_values, std::size_t{4} * cut.tet_count, gl::TexelFormat::r32f};
        program.bind("tet_values", tet_values);
        set_value_colors(program, *map);
    }
    frame.view.set_uniforms(program);
    program.set("cut_plane", frame.bodies.surfaces.cut_plane());
    program.set("line_width", kSideWidth * frame.view.line_scale());
    glDisable(GL_CULL_FACE);
    program.draw_arrays_indirect(gl::Primitive::triangles, draw_arguments_.id(), 0);
    glEnable(GL_CULL_FACE);
}

}  // namespace gelatin::render
