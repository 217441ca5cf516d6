#include "gpu/collision/find_self_collisions.h"

#include <string>

#include "gelatin/error.h"
#include "gpu/chunks.h"

namespace gelatin::gpu {
namespace {

constexpr std::uint32_t kObjectLanes = 32;  // of find_restless_objects.comp
constexpr std::size_t kMostGroups = 65535;
constexpr std::size_t kMostFaces =
    kMostGroups * 64;  // of a list that is gone through by one row of work groups

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
    nodes.position_texels.bind(0);
    self.rest_offset_texels.bind(1);
    collision.dispatches.bind_storage(6);
    find_restless_objects(collision, self);
    fit(collision, self);
    list_restless_faces(model, collision, self);
    find_contacts(model, collision, self);
}

void FindSelfCollisions::find_restless_objects(const CollisionBuffers& collision,
                                               const SelfCollisionBuffers& self) const {
    self.fit_texels.bind(2);
    chunk_texels_.bind(3);
    self.last_restless.bind_storage(3);
    object_program_.set("chunk_count", node_chunk_count_);
    object_program_.set("step_number", step_number_);
    object_program_.dispatch(kObjectLanes * static_cast<std::size_t>(node_chunk_count_), kObjectLanes);
    gl::barrier(gl::Barrier::storage);

    node_chunks_.bind_storage(4);
    face_chunks_.bind_storage(5);
    objects_.bind_storage(7);
    chunk_program_.set("node_chunk_count", node_chunk_count_);
    chunk_program_.set("chunk_count", static_cast<std::uint32_t>(chunks_.size()));
    chunk_program_.set("object_count", collision.object_count);
    chunk_program_.set("step_number", step_number_);
    chunk_program_.dispatch(chunks_.size());
    gl::barrier(gl::Barrier::storage | gl::Barrier::command);
}

void FindSelfCollisions::fit(const CollisionBuffers& collision, const SelfCollisionBuffers& self) const {
    using Work = CollisionBuffers::Work;
    collision.bounding_boxes.bind_storage(0);
    node_chunks_.bind_storage(1);
    chunks_.bind_storage(3);
    sums_.bind_storage(4);
    rest_shapes_.bind_storage(5);
    self.fits.bind_storage(7);
    chunk_start_texels_.bind(2);
    collision.run(sum_program_, Work::fit_sums);
    gl::barrier(gl::Barrier::storage);
    objects_.bind_storage(1);
    collision.run(fit_program_, Work::fits);
    gl::barrier(gl::Barrier::texture_fetch | gl::Barrier::storage);
}

void FindSelfCollisions::list_restless_faces(const ModelBuffers& model, const CollisionBuffers& collision,
                                             const SelfCollisionBuffers& self) const {
    self.fit_texels.bind(2);
    self.clearance_texels.bind(4);
    model.face_texels.bind(7);
    face_chunks_.bind_storage(3);
    self.restless.bind_storage(4);
    self.is_calm.bind_storage(5);
    self.contact_counts.bind_storage(7);
    list_program_.set("face_count", self.face_count);
    collision.run(list_program_, CollisionBuffers::Work::restless_chunks);
    gl::barrier(gl::Barrier::storage | gl::Barrier::command);
}

void FindSelfCollisions::find_contacts(const ModelBuffers& model, const CollisionBuffers& collision,
                                       const SelfCollisionBuffers& self) const {
    using Work = CollisionBuffers::Work;
    const auto capacity = static_cast<std::uint32_t>(collision.face_pairs.size());
    collision.face_trees.node_texels.bind(4);
    collision.face_trees.box_texels.bind(5);
    collision.face_trees.root_texels.bind(6);
    collision.face_boxes.bind_storage(3);
    collision.face_pairs.bind_storage(7);
    walk_program_.set("face_pair_capacity", capacity);
    collision.run(walk_program_, Work::restless);
    gl::barrier(gl::Barrier::storage | gl::Barrier::command);

    self.colliding.bind_storage(4);
    self.contact_counts.bind_storage(5);
    test_program_.set("face_pair_capacity", capacity);
    test_program_.set("face_count", self.face_count);
    test_program_.set("node_count", model.node_count);
    collision.run(test_program_, Work::self_pairs);
    gl::barrier(gl::Barrier::storage | gl::Barrier::command);
}

}  // namespace gelatin::gpu
