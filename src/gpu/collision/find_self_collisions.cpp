#include "gpu/collision/find_self_collisions.h"

#include <string>

#include "gelatin/error.h"
#include "gpu/chunks.h"

namespace gelatin::gpu {
namespace {

constexpr std::size_t kMostGroups = 65535;
constexpr std::size_t kMostFaces = kMostGroups * 64;  // of a list that one row of work groups processes

void check_size(const Model& model, std::size_t node_chunks, std::size_t face_chunks) {
    if (model.faces.size() <= kMostFaces && node_chunks <= kMostGroups && face_chunks <= kMostGroups) return;
    throw InvalidInput({{},
                        0,
                        "collision.self_collision",
                        "true",
                        "is for scenes of at most " + std::to_string(kMostFaces) + " faces, and " +
                            std::to_string(kMostGroups) +
                            " objects or parts of 256 of their nodes or faces"});
}

std::vector<std::uint32_t> starts_of(const std::vector<Chunk>& chunks, std::size_t object_count) {
    std::vector<std::uint32_t> starts(object_count + 1, 0);
    for (const Chunk& chunk : chunks) ++starts[chunk.object + 1];
    for (std::size_t o = 0; o < object_count; ++o) starts[o + 1] += starts[o];
    return starts;
}

}  // namespace

FindSelfCollisions::FindSelfCollisions(const Model& model)
    : object_program_(gl::Program::compute("sim/collision/find_restless_objects.comp")),
      chunk_program_(gl::Program::compute("sim/collision/list_restless_chunks.comp")),
      sum_program_(gl::Program::compute("sim/collision/fit_rest_shapes.comp")),
      fit_program_(gl::Program::compute("sim/collision/fit_rest_shapes.comp", {"OBJECTS"})),
      list_program_(gl::Program::compute("sim/collision/list_restless_faces.comp")),
      walk_program_(gl::Program::compute("sim/collision/walk_own_trees.comp")),
      test_program_(gl::Program::compute("sim/collision/test_own_face_pairs.comp")),
      rest_shapes_(std::span<const RestShape>(model.rest_shapes.objects)),
      objects_(model.objects.size()) {
    std::vector<Chunk> chunks = make_chunks(model, &ModelObject::nodes);
    const std::vector<Chunk> face_chunks = make_chunks(model, &ModelObject::faces);
    check_size(model, chunks.size(), face_chunks.size());
    node_chunk_count_ = static_cast<std::uint32_t>(chunks.size());
    sums_ = gl::Buffer<FitSums>(chunks.size());
    node_chunks_ = gl::Buffer<std::uint32_t>(chunks.size());
    face_chunks_ = gl::Buffer<std::uint32_t>(face_chunks.size());
    const std::vector<std::uint32_t> starts = starts_of(chunks, model.objects.size());
    chunk_starts_ = gl::Buffer<std::uint32_t>(std::span<const std::uint32_t>(starts));
    chunk_start_texels_ = gl::BufferTexture(chunk_starts_, gl::TexelFormat::r32ui);
    chunks.insert(chunks.end(), face_chunks.begin(), face_chunks.end());
    chunks_ = gl::Buffer<Chunk>(std::span<const Chunk>(chunks));
    chunk_texels_ = gl::BufferTexture(chunks_, gl::TexelFormat::rgba32ui);
}

void FindSelfCollisions::run(const ModelBuffers& model, const CollisionBuffers& collision,
                             const SelfCollisionBuffers& self, const NodeBuffers& nodes) {
    ++step_number_;
    for (const gl::Program* program : {&object_program_, &sum_program_, &fit_program_, &list_program_}) {
        program->bind("positions", nodes.position_texels);
        program->bind("rest_offsets", self.rest_offset_texels);
    }
    test_program_.bind("positions", nodes.position_texels);
    for (const gl::Program* program : {&object_program_, &chunk_program_, &sum_program_, &fit_program_,
                                       &list_program_, &walk_program_, &test_program_})
        program->bind("Dispatches", collision.dispatches);
    find_restless_objects(collision, self);
    fit(collision, self);
    list_restless_faces(model, collision, self);
    find_contacts(model, collision, self);
}

void FindSelfCollisions::find_restless_objects(const CollisionBuffers& collision,
                                               const SelfCollisionBuffers& self) const {
    object_program_.bind("fits", self.fit_texels);
    object_program_.bind("chunks", chunk_texels_);
    object_program_.bind("LastRestless", self.last_restless);
    object_program_.set("chunk_count", node_chunk_count_);
    object_program_.set("step_number", step_number_);
    object_program_.dispatch_groups(node_chunk_count_);
    gl::barrier(gl::Barrier::storage);

    chunk_program_.bind("chunks", chunk_texels_);
    chunk_program_.bind("LastRestless", self.last_restless);
    chunk_program_.bind("RestlessNodeChunks", node_chunks_);
    chunk_program_.bind("RestlessFaceChunks", face_chunks_);
    chunk_program_.bind("RestlessObjects", objects_);
    chunk_program_.set("node_chunk_count", node_chunk_count_);
    chunk_program_.set("chunk_count", static_cast<std::uint32_t>(chunks_.size()));
    chunk_program_.set("object_count", collision.object_count);
    chunk_program_.set("step_number", step_number_);
    chunk_program_.dispatch(chunks_.size());
    gl::barrier(gl::Barrier::storage | gl::Barrier::command);
}

void FindSelfCollisions::fit(const CollisionBuffers& collision, const SelfCollisionBuffers& self) const {
    for (const gl::Program* program : {&sum_program_, &fit_program_}) {
        program->bind("BoundingBoxes", collision.bounding_boxes);
        program->bind("Chunks", chunks_);
        program->bind("Sums", sums_);
        program->bind("RestShapes", rest_shapes_);
        program->bind("Fits", self.fits);
    }
    sum_program_.bind("RestlessNodeChunks", node_chunks_);
    collision.run(sum_program_, dispatch_slots::kFitSums);
    gl::barrier(gl::Barrier::storage);
    fit_program_.bind("RestlessObjects", objects_);
    fit_program_.bind("chunk_starts", chunk_start_texels_);
    collision.run(fit_program_, dispatch_slots::kFits);
    gl::barrier(gl::Barrier::texture_fetch | gl::Barrier::storage);
}

void FindSelfCollisions::list_restless_faces(const ModelBuffers& model, const CollisionBuffers& collision,
                                             const SelfCollisionBuffers& self) const {
    list_program_.bind("fits", self.fit_texels);
    list_program_.bind("chunks", chunk_texels_);
    list_program_.bind("clearances", self.clearance_texels);
    list_program_.bind("faces", model.face_texels);
    list_program_.bind("RestlessFaceChunks", face_chunks_);
    list_program_.bind("RestlessFaces", self.restless);
    list_program_.bind("Calm", self.is_calm);
    list_program_.bind("ContactCounts", self.contact_counts);
    list_program_.set("face_count", self.face_count);
    collision.run(list_program_, dispatch_slots::kRestlessChunks);
    gl::barrier(gl::Barrier::storage | gl::Barrier::command);
}

void FindSelfCollisions::find_contacts(const ModelBuffers& model, const CollisionBuffers& collision,
                                       const SelfCollisionBuffers& self) const {
    const auto capacity = static_cast<std::uint32_t>(collision.face_pairs.size());
    collision.bind_own_trees(walk_program_, model);
    walk_program_.bind("RestlessFaces", self.restless);
    walk_program_.bind("Calm", self.is_calm);
    walk_program_.bind("FacePairs", collision.face_pairs);
    walk_program_.set("face_pair_capacity", capacity);
    collision.run(walk_program_, dispatch_slots::kRestless);
    gl::barrier(gl::Barrier::storage | gl::Barrier::command);

    test_program_.bind("faces", model.face_texels);
    test_program_.bind("FacePairs", collision.face_pairs);
    test_program_.bind("SelfFaces", self.colliding);
    test_program_.bind("ContactCounts", self.contact_counts);
    test_program_.set("face_pair_capacity", capacity);
    test_program_.set("face_count", self.face_count);
    test_program_.set("node_count", model.node_count);
    collision.run(test_program_, dispatch_slots::kSelfPairs);
    gl::barrier(gl::Barrier::storage | gl::Barrier::command);
}

}  // namespace gelatin::gpu
