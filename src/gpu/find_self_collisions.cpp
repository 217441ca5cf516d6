#include "gpu/find_self_collisions.h"

#include <string>

#include "gelatin/error.h"
#include "gpu/chunks.h"

namespace gelatin::gpu {
namespace {

constexpr std::size_t kMostFaces = 65535u * 64u;  // of a list that is gone through by one row of work groups

std::vector<std::uint32_t> starts_of(const std::vector<Chunk>& chunks, std::size_t object_count) {
    std::vector<std::uint32_t> starts(object_count + 1, 0);
    for (const Chunk& chunk : chunks) ++starts[chunk.object + 1];
    for (std::size_t o = 0; o < object_count; ++o) starts[o + 1] += starts[o];
    return starts;
}

}  // namespace

FindSelfCollisions::FindSelfCollisions(const Model& model)
    : sum_program_(gl::Program::compute("sim/fit_rest_shapes.comp")),
      fit_program_(gl::Program::compute("sim/fit_rest_shapes.comp", {"OBJECTS"})),
      list_program_(gl::Program::compute("sim/list_restless_faces.comp")),
      walk_program_(gl::Program::compute("sim/walk_own_trees.comp")),
      test_program_(gl::Program::compute("sim/test_own_face_pairs.comp")),
      rest_shapes_(std::span<const RestShape>(model.rest_shapes.objects)) {
    if (model.faces.size() > kMostFaces) {
        throw InvalidInput({{},
                            0,
                            "collision.self_collision",
                            "true",
                            "is for scenes of at most " + std::to_string(kMostFaces) + " faces"});
    }
    const std::vector<Chunk> chunks = make_chunks(model, &ModelObject::nodes);
    chunks_ = gl::Buffer<Chunk>(std::span<const Chunk>(chunks));
    const std::vector<std::uint32_t> starts = starts_of(chunks, model.objects.size());
    chunk_starts_ = gl::Buffer<std::uint32_t>(std::span<const std::uint32_t>(starts));
    chunk_start_texels_ = gl::BufferTexture(chunk_starts_, gl::TexelFormat::r32ui);
    sums_ = gl::Buffer<FitSums>(chunks.size());
}

void FindSelfCollisions::run(const ModelBuffers& model, const CollisionBuffers& collision,
                             const SelfCollisionBuffers& self, const NodeBuffers& nodes) const {
    using Work = CollisionBuffers::Work;
    nodes.position_texels.bind(0);
    self.rest_offset_texels.bind(1);
    collision.dispatches.bind_storage(6);
    fit(collision, self);

    model.face_texels.bind(2);
    self.clearance_texels.bind(3);
    self.fits.bind_storage(3);
    self.restless.bind_storage(4);
    self.is_calm.bind_storage(5);
    self.contact_counts.bind_storage(7);
    list_program_.set("face_count", self.face_count);
    list_program_.dispatch(self.face_count);
    gl::barrier(gl::Barrier::storage | gl::Barrier::command);

    const auto capacity = static_cast<std::uint32_t>(collision.face_pairs.size());
    collision.face_trees.node_texels.bind(4);
    collision.face_trees.box_texels.bind(5);
    collision.face_trees.root_texels.bind(6);
    model.face_texels.bind(7);
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

void FindSelfCollisions::fit(const CollisionBuffers& collision, const SelfCollisionBuffers& self) const {
    collision.bounding_boxes.bind_storage(0);
    chunks_.bind_storage(3);
    sums_.bind_storage(4);
    rest_shapes_.bind_storage(5);
    self.fits.bind_storage(7);
    chunk_start_texels_.bind(2);
    sum_program_.set("element_count", static_cast<std::uint32_t>(chunks_.size()));
    sum_program_.dispatch(64 * chunks_.size());
    gl::barrier(gl::Barrier::storage);
    fit_program_.set("element_count", collision.object_count);
    fit_program_.dispatch(collision.object_count);
    gl::barrier(gl::Barrier::storage);
}

}  // namespace gelatin::gpu
