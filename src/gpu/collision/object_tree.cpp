#include "gpu/collision/object_tree.h"

#include <cstring>

#include "gpu/collision/update_boxes.h"
#include "model/collision/box_tree.h"

namespace gelatin::gpu {
namespace {

BoxTree make_tree(std::uint32_t items) {
    BoxTree tree;
    append_box_tree({0, items}, tree);
    tree.nodes[0].root_of = 0xFFFFFFFFu;  // its box bounds no object
    return tree;
}

std::vector<std::uint32_t> order_at_start(const Model& model) {
    std::vector<glm::dvec3> centers;
    for (const ModelObject& object : model.objects) {
        glm::dvec3 sum(0.0);
        for (std::uint32_t n = object.nodes.first; n < object.nodes.end(); ++n)
            sum += glm::dvec3(model.positions[n]);
        centers.push_back(sum / static_cast<double>(object.nodes.count));
    }
    return box_tree_order(centers);
}

}  // namespace

ObjectTree::ObjectTree(const Model& model)
    : tree_(make_tree(static_cast<std::uint32_t>(model.objects.size()))),
      leaf_program_(gl::Program::compute("sim/collision/update_boxes.comp", {"OBJECTS"})),
      node_program_(gl::Program::compute("sim/collision/update_boxes.comp")),
      order_(std::span<const std::uint32_t>(order_at_start(model))),
      order_texels_(order_, gl::TexelFormat::r32ui) {}

void ObjectTree::update(const CollisionBuffers& collision) {
    const bool has_choice = collision.object_count > BoxTree::kLeafItems;
    if (has_choice) renew_order();
    leaf_program_.bind("object_order", order_texels_);
    for (const gl::Program* program : {&leaf_program_, &node_program_})
        bind_levels(*program, tree_, collision.bounding_boxes);
    for (std::size_t level = 0; level < tree_.level_count(); ++level)
        update_level(level == 0 ? leaf_program_ : node_program_, tree_, level);
    // Behind all that may write boxes in this step: the copy is theirs.
    if (has_choice) fetch_boxes(collision);
}

void ObjectTree::renew_order() {
    if (readback_.pending() > 0 && readback_.ready()) {
        const std::vector<std::byte> bytes = readback_.take();
        std::vector<BoundingBox> boxes(bytes.size() / sizeof(BoundingBox));
        std::memcpy(boxes.data(), bytes.data(), bytes.size());
        std::vector<glm::dvec3> centers;
        for (const BoundingBox& box : boxes) centers.emplace_back(0.5f * (box.min + box.max));
        order_.upload(box_tree_order(centers));
    }
}

void ObjectTree::fetch_boxes(const CollisionBuffers& collision) {
    if (age_ == 0 && readback_.pending() == 0) {
        readback_.begin(collision.bounding_boxes.id(), collision.bounding_boxes.size() * sizeof(BoundingBox));
    }
    age_ = (age_ + 1) % kOrderLifetime;
}

void ObjectTree::bind(const gl::Program& program) const {
    program.bind("object_tree_nodes", tree_.node_texels);
    program.bind("object_tree_boxes", tree_.box_texels);
    program.bind("object_order", order_texels_);
}

}  // namespace gelatin::gpu
