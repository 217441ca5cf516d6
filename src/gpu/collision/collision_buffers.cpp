#include "gpu/collision/collision_buffers.h"

#include <algorithm>
#include <limits>
#include <string>

#include "gelatin/error.h"
#include "model/collision/face_collision_words.h"

namespace gelatin::gpu {
namespace {

constexpr std::uint64_t kOne = 1;                    // no buffer is empty
constexpr std::uint64_t kMostPairs = 1u << 20;       // 32 MB
constexpr std::uint64_t kMostCandidates = 1u << 22;  // 16 MB, or eight a face
constexpr std::uint64_t kMostWords = 1u << 23;       // 32 MB
constexpr std::uint64_t kLeastFacePairs = 1u << 16;  // 1 MB
constexpr std::uint64_t kFacePairsAFace = 64;
constexpr std::uint64_t kMostFacePairs = 1u << 21;  // 32 MB

// Sums over all pairs of objects.
struct AllPairs {
    std::uint64_t pairs = 0, words = 0, entries = 0;

    explicit AllPairs(const Model& model) {
        const std::uint64_t others = model.objects.size() - 1;
        for (const ModelObject& object : model.objects) {
            pairs += others;
            words += others * face_collision_words(object.faces.count);
            entries += others * object.faces.count;
            if (others * object.faces.count > std::numeric_limits<std::uint32_t>::max()) {
                throw InvalidInput("object '" + object.name + "' has too many faces for a scene of " +
                                   std::to_string(model.objects.size()) + " objects");
            }
        }
    }
};

std::vector<BoundingBox> describe_objects(const Model& model) {
    std::vector<BoundingBox> boxes;
    for (std::uint32_t o = 0; o < model.objects.size(); ++o) {
        const ModelObject& object = model.objects[o];
        boxes.push_back({glm::vec4(0.0f), glm::vec4(0.0f), o, object.nodes.count, object.faces.count,
                         object.faces.first});
    }
    return boxes;
}

}  // namespace

CollisionBuffers::CollisionBuffers(const Model& model)
    : face_trees(model.face_trees),
      face_boxes(model.faces.size()),
      face_views(model.faces.size()),
      object_views(model.objects.size()),
      face_view_texels(face_views, gl::TexelFormat::r32ui),
      object_view_texels(object_views, gl::TexelFormat::r32ui),
      node_face_starts(std::span(model.node_faces.starts)),
      node_faces(std::span(model.node_faces.faces)),
      node_face_start_texels(node_face_starts, gl::TexelFormat::r32ui),
      node_face_texels(node_faces, gl::TexelFormat::r32ui),
      object_count(static_cast<std::uint32_t>(model.objects.size())) {
    const std::vector<BoundingBox> boxes = describe_objects(model);
    bounding_boxes = gl::Buffer<BoundingBox>(std::span(boxes));

    const std::vector<PairRow> no_pairs(model.objects.size(), PairRow{0, 0, 0, 0});  // until they are sought
    pair_rows = gl::Buffer<PairRow>(std::span(no_pairs));
    const AllPairs all(model);
    const std::uint64_t faces = model.faces.size();
    object_pairs = gl::Buffer<ObjectPair>(std::clamp(all.pairs, kOne, kMostPairs));
    face_collisions = gl::Buffer<std::uint32_t>(std::clamp(all.words, kOne, kMostWords));
    candidates =
        gl::Buffer<std::uint32_t>(std::clamp(all.entries, kOne, std::max(kMostCandidates, 8 * faces)));
    face_pairs = gl::Buffer<FacePair>(std::clamp(kFacePairsAFace * faces, kLeastFacePairs, kMostFacePairs));
    const std::vector<Dispatch> nothing(dispatch_slots::kDispatchSlots, Dispatch{0, 1, 1, 0});
    dispatches = gl::Buffer<Dispatch>(std::span(nothing));
}

void CollisionBuffers::bind_pairs(const gl::Program& program) const {
    program.bind("BoundingBoxes", bounding_boxes);
    program.bind("PairRows", pair_rows);
    program.bind("ObjectPairs", object_pairs);
    program.bind("Dispatches", dispatches);
}

void CollisionBuffers::bind_node_faces(const gl::Program& program) const {
    program.bind("node_face_starts", node_face_start_texels);
    program.bind("node_faces", node_face_texels);
}

void CollisionBuffers::bind_own_trees(const gl::Program& program, const ModelBuffers& model) const {
    face_trees.bind(program);
    program.bind("faces", model.face_texels);
    program.bind("FaceBoxes", face_boxes);
}

void CollisionBuffers::bind_hidden(const gl::Program& program) const {
    program.bind("face_views", face_view_texels);
    program.bind("object_views", object_view_texels);
}

void CollisionBuffers::run(const gl::Program& program, std::uint32_t slot) const {
    program.dispatch_indirect(dispatches.id(), std::size_t{slot} * sizeof(Dispatch));
}

}  // namespace gelatin::gpu
