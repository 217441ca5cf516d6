#include "gpu/match_shapes.h"

#include <span>

#include "gpu/chunks.h"
#include "gpu/make_buffer.h"
#include "model/descent_rows.h"
#include "model/match_shapes.h"

namespace gelatin::gpu {
namespace {

std::vector<glm::vec4> volumes_of(const Model& model) {
    std::vector<glm::vec4> volumes;
    for (const TetRest& rest : model.tet_rests) volumes.emplace_back(rest.volume, 0.0f, 0.0f, 0.0f);
    return volumes;
}

}  // namespace

ShapeMatcher::ShapeMatcher(const Model& model)
    : count_program_(gl::Program::compute("sim/count_inverted_tets.comp")),
      sum_program_(gl::Program::compute("sim/match_shapes.comp")),
      match_program_(gl::Program::compute("sim/match_shapes.comp", {"OBJECTS"})),
      place_program_(gl::Program::compute("sim/place_shapes.comp")),
      node_count_(model.node_count()),
      tet_count_(static_cast<std::uint32_t>(model.tets.size())),
      object_count_(static_cast<std::uint32_t>(model.objects.size())),
      tets_(make_buffer(model.tets)),
      tet_rests_(make_buffer(volumes_of(model))),
      node_objects_(make_buffer(objects_of_nodes(model))),
      inverted_(model.objects.size()),
      places_(model.objects.size()) {
    const MatchShapes shapes = make_match_shapes(model);
    rest_offsets_ = make_buffer(shapes.offsets);
    rest_moments_ = make_buffer(shapes.objects);
    const std::vector<Chunk> chunks = make_chunks(model, &ModelObject::nodes);
    chunks_ = make_buffer(chunks);
    chunk_starts_ = make_buffer(chunk_starts(chunks, model.objects.size()));
    sums_ = gl::Buffer<ShapeSums>(chunks.size());
    inverted_.fill(0);

    tet_texels_ = {tets_, gl::TexelFormat::rgba32ui};
    tet_rest_texels_ = {tet_rests_, gl::TexelFormat::rgba32f};
    rest_offset_texels_ = {rest_offsets_, gl::TexelFormat::rgba32f};
    node_object_texels_ = {node_objects_, gl::TexelFormat::r32ui};
    chunk_start_texels_ = {chunk_starts_, gl::TexelFormat::r32ui};
}

void ShapeMatcher::run(const NodeBuffers& nodes) const {
    nodes.position_texels.bind(0);
    tet_texels_.bind(9);
    tet_rest_texels_.bind(10);
    node_object_texels_.bind(12);
    inverted_.bind_storage(4);
    count_program_.set("tet_count", tet_count_);
    count_program_.dispatch(tet_count_);
    gl::barrier(gl::Barrier::storage);

    nodes.velocity_texels.bind(2);
    chunk_start_texels_.bind(3);
    rest_offset_texels_.bind(4);
    rest_moments_.bind_storage(2);
    chunks_.bind_storage(3);
    sums_.bind_storage(5);
    places_.bind_storage(6);
    sum_program_.set("element_count", static_cast<std::uint32_t>(chunks_.size()));
    sum_program_.dispatch(64 * chunks_.size());
    gl::barrier(gl::Barrier::storage);

    match_program_.set("element_count", object_count_);
    match_program_.dispatch(object_count_);
    gl::barrier(gl::Barrier::storage);

    nodes.positions.bind_storage(0);
    nodes.velocities.bind_storage(1);
    place_program_.set("node_count", node_count_);
    place_program_.dispatch(node_count_);
    gl::barrier(gl::Barrier::texture_fetch | gl::Barrier::storage);
}

}  // namespace gelatin::gpu
