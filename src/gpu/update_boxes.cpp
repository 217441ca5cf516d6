#include "gpu/update_boxes.h"

namespace gelatin::gpu {

UpdateBoxes::UpdateBoxes(CollisionDetection detection)
    : leaf_program_(gl::Program::compute("sim/update_boxes.comp", detection == CollisionDetection::continuous
                                                                      ? gl::Defines{"LEAVES", "CONTINUOUS"}
                                                                      : gl::Defines{"LEAVES"})),
      node_program_(gl::Program::compute("sim/update_boxes.comp")) {}

void update_level(const gl::Program& program, const TreeBuffers& trees, std::size_t level) {
    const std::uint32_t first = trees.level_starts[level], count = trees.level_starts[level + 1] - first;
    program.set("first_node", first);
    program.set("node_count", count);
    program.dispatch(count);
    gl::barrier(gl::Barrier::storage | gl::Barrier::texture_fetch);
}

void UpdateBoxes::run(const ModelBuffers& model, const CollisionBuffers& collision,
                      const NodeBuffers& previous, const NodeBuffers& nodes) const {
    const TreeBuffers& trees = collision.face_trees;
    nodes.position_texels.bind(0);
    trees.node_texels.bind(1);
    previous.position_texels.bind(3);
    collision.bounding_boxes.bind_storage(0);
    model.faces.bind_storage(1);
    collision.face_boxes.bind_storage(2);
    trees.boxes.bind_storage(3);
    trees.level_nodes.bind_storage(4);
    for (std::size_t level = 0; level < trees.level_count(); ++level)
        update_level(level == 0 ? leaf_program_ : node_program_, trees, level);
}

}  // namespace gelatin::gpu
