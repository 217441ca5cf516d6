#include "gpu/recovery/match_shapes.h"

#include <span>

#include "gpu/chunks.h"
#include "model/recovery/match_shapes.h"

namespace gelatin::gpu {
namespace {

constexpr std::size_t kDispatches = 2;

std::vector<glm::vec4> volumes_of(const Model& model) {
    std::vector<glm::vec4> volumes;
    for (const TetRest& rest : model.tet_rests) volumes.emplace_back(rest.volume, 0.0f, 0.0f, 0.0f);
    return volumes;
}

std::uint32_t groups_of(std::uint32_t invocations) {
    constexpr std::uint32_t kLanes = 64;
    return (invocations + kLanes - 1) / kLanes;
}

}  // namespace

ShapeMatcher::ShapeMatcher(const Model& model)
    : count_program_(gl::Program::compute("sim/recovery/count_inverted_tets.comp")),
      sum_program_(gl::Program::compute("sim/recovery/match_shapes.comp")),
      match_program_(gl::Program::compute("sim/recovery/match_shapes.comp", {"OBJECTS"})),
      place_program_(gl::Program::compute("sim/recovery/place_shapes.comp")),
      node_count_(model.node_count()),
      tet_count_(static_cast<std::uint32_t>(model.tets.size())),
      object_count_(static_cast<std::uint32_t>(model.objects.size())),
      tets_(model.tets, gl::TexelFormat::rgba32ui),
      tet_rests_(volumes_of(model), gl::TexelFormat::rgba32f),
      node_objects_(model.node_objects, gl::TexelFormat::r32ui),
      inverted_(kDispatches * sizeof(Dispatch) / sizeof(std::uint32_t) + model.objects.size()),
      places_(model.objects.size()),
      lost_for_(model.objects.size()) {
    forget();
    const MatchShapes shapes = make_match_shapes(model);
    rest_offsets_ = {shapes.offsets, gl::TexelFormat::rgba32f};
    rest_moments_ = gl::Buffer<RestMoment>(shapes.objects);
    const std::vector<Chunk> chunks = make_chunks(model, &ModelObject::nodes);
    chunks_ = gl::Buffer<Chunk>(chunks);
    chunk_starts_ = {chunk_starts(chunks, model.objects.size()), gl::TexelFormat::r32ui};
    sums_ = gl::Buffer<ShapeSums>(chunks.size());

    count_program_.bind("tets", tets_);
    count_program_.bind("tet_rests", tet_rests_);
    count_program_.bind("node_objects", node_objects_);
    for (const gl::Program* program : {&count_program_, &sum_program_, &match_program_}) {
        program->bind("RestMoments", rest_moments_);
        program->bind("Inverted", inverted_);
    }
    for (const gl::Program* program : {&sum_program_, &match_program_}) {
        program->bind("chunk_starts", chunk_starts_);
        program->bind("rest_offsets", rest_offsets_);
        program->bind("Chunks", chunks_);
        program->bind("Sums", sums_);
        program->bind("Places", places_);
    }
    match_program_.bind("LostFor", lost_for_);
    place_program_.bind("rest_offsets", rest_offsets_);
    place_program_.bind("node_objects", node_objects_);
    place_program_.bind("Places", places_);
}

void ShapeMatcher::forget() {
    set_lost_for(std::vector<float>(lost_for_.size(), static_cast<float>(kPatience)));
}

std::vector<float> ShapeMatcher::lost_for() const {
    std::vector<float> times(lost_for_.size());
    lost_for_.download(times);
    return times;
}

void ShapeMatcher::run(const NodeBuffers& nodes, double elapsed) {
    inverted_.fill(0);
    for (const gl::Program* program : {&count_program_, &sum_program_, &match_program_})
        program->bind("positions", nodes.position_texels);
    for (const gl::Program* program : {&sum_program_, &match_program_})
        program->bind("velocities", nodes.velocity_texels);
    place_program_.bind("Positions", nodes.positions);
    place_program_.bind("Velocities", nodes.velocities);
    count_program_.set("tet_count", tet_count_);
    count_program_.set("chunk_groups", static_cast<std::uint32_t>(chunks_.size()));
    count_program_.set("node_groups", groups_of(node_count_));
    count_program_.dispatch(tet_count_);
    gl::barrier(gl::Barrier::storage | gl::Barrier::command);

    sum_program_.set("element_count", static_cast<std::uint32_t>(chunks_.size()));
    sum_program_.dispatch_indirect(inverted_.id(), 0);
    gl::barrier(gl::Barrier::storage);

    match_program_.set("element_count", object_count_);
    match_program_.set("elapsed", static_cast<float>(elapsed));
    match_program_.dispatch(object_count_);
    gl::barrier(gl::Barrier::storage);

    place_program_.set("node_count", node_count_);
    place_program_.dispatch_indirect(inverted_.id(), sizeof(Dispatch));
    gl::barrier(gl::Barrier::texture_fetch | gl::Barrier::storage);
}

}  // namespace gelatin::gpu
