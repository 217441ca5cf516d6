#include "gpu/proximity/find_proximities.h"

#include "gpu/collision/update_boxes.h"

namespace gelatin::gpu {
namespace {

using Work = CollisionBuffers::Work;

constexpr std::uint32_t kSumLanes = 256,
                        kGroupQueries = 16 * kSumLanes;  // of sim/proximity/sum_proximities.comp
constexpr auto kNext = gl::Barrier::storage | gl::Barrier::texture_fetch | gl::Barrier::command;

template <class T>
std::uint32_t capacity(const gl::Buffer<T>& buffer) {
    return static_cast<std::uint32_t>(buffer.size());
}

// The tasks of nodes, then those of edges, whose queries come behind the nodes'.
void run_tasks(const gl::Program& of_nodes, const gl::Program& of_edges, const CollisionBuffers& collision,
               const ProximityBuffers& buffers) {
    const auto run = [&](const gl::Program& program, const ProximityBuffers::Tasks& tasks, Work work,
                         std::uint32_t first_query) {
        tasks.hits.bind_storage(4);
        tasks.leaves.bind_storage(5);
        program.set("task_capacity", capacity(tasks.leaves));
        program.set("first_query", first_query);
        collision.run(program, work);
        gl::barrier(gl::Barrier::storage);  // both add to the same buffers
    };
    run(of_nodes, buffers.node_tasks, Work::node_tasks, 0);
    run(of_edges, buffers.edge_tasks, Work::edge_tasks, buffers.node_count);
}

}  // namespace

FindProximities::FindProximities(double radius, bool own)
    : squared_radius_(static_cast<float>(radius) * static_cast<float>(radius)),
      begin_program_(gl::Program::compute("sim/proximity/begin_proximities.comp")),
      object_program_(gl::Program::compute("sim/proximity/list_near_objects.comp",
                                           own ? gl::Defines{"OWN"} : gl::Defines{})),
      count_program_(gl::Program::compute("sim/proximity/walk_near_objects.comp")),
      task_program_(gl::Program::compute("sim/proximity/list_proximity_tasks.comp")),
      list_program_(gl::Program::compute("sim/proximity/walk_near_objects.comp", {"LIST"})),
      test_nodes_program_(gl::Program::compute("sim/proximity/test_proximities.comp")),
      test_edges_program_(gl::Program::compute("sim/proximity/test_proximities.comp", {"EDGES"})),
      sum_program_(gl::Program::compute("sim/proximity/sum_proximities.comp")),
      sum_groups_program_(gl::Program::compute("sim/proximity/sum_proximities.comp", {"GROUPS"})),
      start_program_(gl::Program::compute("sim/proximity/sum_proximities.comp", {"STARTS"})),
      write_nodes_program_(gl::Program::compute("sim/proximity/write_proximities.comp")),
      write_edges_program_(gl::Program::compute("sim/proximity/write_proximities.comp", {"EDGES"})) {
    for (const gl::Program* program : {&test_nodes_program_, &test_edges_program_}) {
        set_margin(*program, radius);
        program->set("squared_radius", squared_radius_);
    }
}

void FindProximities::run(const ModelBuffers& model, const CollisionBuffers& collision,
                          const ProximityBuffers& buffers, const NodeBuffers& nodes) const {
    collision.bind_pairs();
    buffers.starts.bind_storage(7);
    buffers.found.bind_storage(1);
    begin_program_.set("query_count", buffers.query_count);
    begin_program_.dispatch(buffers.query_count + 1);
    gl::barrier(gl::Barrier::storage);

    nodes.position_texels.bind(0);
    collision.face_trees.node_texels.bind(1);
    collision.face_trees.box_texels.bind(2);
    model.face_texels.bind(3);
    buffers.face_box_texels.bind(4);
    buffers.leaf_node_texels.bind(5);
    buffers.face_start_texels.bind(6);
    buffers.surface_node_texels.bind(7);
    buffers.face_edge_texels.bind(8);
    find_near_leaves(collision, buffers);
    test(collision, buffers);
    sum_up(buffers);
    write(collision, buffers);
}

void FindProximities::find_near_leaves(const CollisionBuffers& collision,
                                       const ProximityBuffers& buffers) const {
    collision.bind_pairs();
    buffers.searches.bind_storage(3);
    buffers.near_objects.bind_storage(4);
    object_program_.set("search_count", buffers.leaf_count);
    object_program_.set("near_object_capacity", capacity(buffers.near_objects));
    object_program_.dispatch(buffers.leaf_count);
    gl::barrier(kNext);

    collision.face_trees.root_texels.bind(9);
    buffers.near_leaves.bind_storage(5);
    count_program_.set("near_object_capacity", capacity(buffers.near_objects));
    collision.run(count_program_, Work::near_objects);
    gl::barrier(kNext);

    buffers.node_tasks.leaves.bind_storage(5);
    buffers.edge_tasks.leaves.bind_storage(7);
    task_program_.set("search_count", buffers.leaf_count);
    task_program_.set("near_leaf_capacity", capacity(buffers.near_leaves));
    task_program_.set("node_task_capacity", capacity(buffers.node_tasks.leaves));
    task_program_.set("edge_task_capacity", capacity(buffers.edge_tasks.leaves));
    task_program_.dispatch(buffers.leaf_count);
    gl::barrier(kNext);

    buffers.near_leaves.bind_storage(5);
    list_program_.set("near_object_capacity", capacity(buffers.near_objects));
    collision.run(list_program_, Work::near_objects);
    gl::barrier(gl::Barrier::texture_fetch);
}

void FindProximities::test(const CollisionBuffers& collision, const ProximityBuffers& buffers) const {
    buffers.near_leaf_texels.bind(9);
    buffers.starts.bind_storage(7);
    run_tasks(test_nodes_program_, test_edges_program_, collision, buffers);
}

void FindProximities::sum_up(const ProximityBuffers& buffers) const {
    buffers.found.bind_storage(1);
    buffers.group_sums.bind_storage(2);
    for (const gl::Program* program : {&sum_program_, &sum_groups_program_, &start_program_}) {
        program->set("query_count", buffers.query_count);
        program->set("node_count", buffers.node_count);
    }
    const std::size_t groups = (buffers.query_count + kGroupQueries - 1) / kGroupQueries;
    sum_program_.dispatch(groups * kSumLanes, kSumLanes);
    gl::barrier(gl::Barrier::storage);
    sum_groups_program_.dispatch(kSumLanes, kSumLanes);
    gl::barrier(gl::Barrier::storage);
    start_program_.dispatch(buffers.query_count + 1, kSumLanes);
    gl::barrier(gl::Barrier::storage);
}

void FindProximities::write(const CollisionBuffers& collision, const ProximityBuffers& buffers) const {
    buffers.proximities.bind_storage(0);
    for (const gl::Program* program : {&write_nodes_program_, &write_edges_program_})
        program->set("proximity_capacity", capacity(buffers.proximities));
    run_tasks(write_nodes_program_, write_edges_program_, collision, buffers);
}

}  // namespace gelatin::gpu
