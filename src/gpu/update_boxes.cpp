#include "gpu/update_boxes.h"

namespace gelatin::gpu {

UpdateBoxes::UpdateBoxes()
    : update_program_(gl::Program::compute("sim/update_boxes.comp")),
      merge_program_(gl::Program::compute("sim/merge_boxes.comp")) {}

void UpdateBoxes::run(const ModelBuffers& model, const CollisionBuffers& collision,
                      const NodeBuffers& nodes) const {
    nodes.position_texels.bind(0);
    collision.chunks.bind_storage(0);
    model.faces.bind_storage(1);
    collision.face_boxes.bind_storage(2);
    collision.chunk_boxes.bind_storage(3);
    update_program_.set("chunk_count", static_cast<std::uint32_t>(collision.chunks.size()));
    update_program_.dispatch(64 * collision.chunks.size());
    gl::barrier(gl::Barrier::storage);

    collision.bounding_boxes.bind_storage(0);
    collision.chunk_boxes.bind_storage(1);
    collision.chunk_starts.bind_storage(2);
    merge_program_.set("object_count", collision.object_count);
    merge_program_.dispatch(std::size_t{64} * collision.object_count);
    gl::barrier(gl::Barrier::storage);
}

}  // namespace gelatin::gpu
