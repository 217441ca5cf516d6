#include "gpu/update_boxes.h"

namespace gelatin::gpu {

UpdateBoxes::UpdateBoxes()
    : leaf_program_(gl::Program::compute("sim/update_boxes.comp", {"LEAVES"})),
      node_program_(gl::Program::compute("sim/update_boxes.comp")) {}

void UpdateBoxes::run(const ModelBuffers& model, const CollisionBuffers& collision,
                      const NodeBuffers& nodes) const {
    nodes.position_texels.bind(0);
    collision.tree_node_texels.bind(1);
    collision.bounding_boxes.bind_storage(0);
    model.faces.bind_storage(1);
    collision.face_boxes.bind_storage(2);
    collision.tree_boxes.bind_storage(3);
    collision.level_nodes.bind_storage(4);
    for (std::size_t level = 0; level + 1 < collision.level_starts.size(); ++level) {
        const gl::Program& program = level == 0 ? leaf_program_ : node_program_;
        const std::uint32_t first = collision.level_starts[level];
        const std::uint32_t count = collision.level_starts[level + 1] - first;
        program.set("first_node", first);
        program.set("node_count", count);
        program.dispatch(count);
        gl::barrier(gl::Barrier::storage | gl::Barrier::texture_fetch);
    }
}

}  // namespace gelatin::gpu
