#include "gpu/collision/update_boxes.h"

#include <limits>

namespace gelatin::gpu {

namespace {

gl::Defines leaf_defines(CollisionDetection detection, double reach) {
    gl::Defines defines{"LEAVES"};
    if (detection == CollisionDetection::continuous) defines.emplace_back("CONTINUOUS");
    if (reach > 0.0) defines.emplace_back("MARGIN");
    return defines;
}

}  // namespace

UpdateBoxes::UpdateBoxes(CollisionDetection detection, double reach)
    : leaf_program_(gl::Program::compute("sim/collision/update_boxes.comp", leaf_defines(detection, reach))),
      node_program_(gl::Program::compute("sim/collision/update_boxes.comp")) {
    set_margin(leaf_program_, reach);
}

void set_margin(const gl::Program& program, double reach) {
    constexpr float kEps = std::numeric_limits<float>::epsilon();
    program.set("box_margin", glm::vec2(static_cast<float>(0.5 * reach) * (1.0f + 8.0f * kEps), 2.0f * kEps));
}

void bind_levels(const gl::Program& program, const TreeBuffers& trees,
                 const gl::Buffer<BoundingBox>& bounding_boxes) {
    program.bind("tree_nodes", trees.node_texels);
    program.bind("BoundingBoxes", bounding_boxes);
    program.bind("TreeBoxes", trees.boxes);
    program.bind("LevelNodes", trees.level_nodes);
}

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
    for (const gl::Program* program : {&leaf_program_, &node_program_})
        bind_levels(*program, trees, collision.bounding_boxes);
    leaf_program_.bind("positions", nodes.position_texels);
    leaf_program_.bind("previous_positions", previous.position_texels);
    leaf_program_.bind("Faces", model.faces);
    leaf_program_.bind("FaceBoxes", collision.face_boxes);
    for (std::size_t level = 0; level < trees.level_count(); ++level)
        update_level(level == 0 ? leaf_program_ : node_program_, trees, level);
}

}  // namespace gelatin::gpu
