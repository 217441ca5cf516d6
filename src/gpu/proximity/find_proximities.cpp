#include "gpu/proximity/find_proximities.h"

#include "gpu/collision/update_boxes.h"

namespace gelatin::gpu {
namespace {

constexpr auto kNext = gl::Barrier::storage | gl::Barrier::texture_fetch | gl::Barrier::command;

template <class T>
std::uint32_t capacity(const gl::Buffer<T>& buffer) {
    return static_cast<std::uint32_t>(buffer.size());
}

// The tasks of nodes, then those of edges, whose queries come after the nodes'.
void run_tasks(const gl::Program& of_nodes, const gl::Program& of_edges, const CollisionBuffers& collision,
               const ProximityBuffers& buffers) {
    const auto run = [&](const gl::Program& program, const ProximityBuffers::Tasks& tasks, std::uint32_t slot,
                         std::uint32_t first_query) {
        program.bind("LeafSearches", buffers.searches);
        program.bind("near_leaves", buffers.near_leaf_texels);
        program.bind("Starts", buffers.starts);
        program.bind("Hits", tasks.hits);
        program.bind("Tasks", tasks.leaves);
        program.set("task_capacity", capacity(tasks.leaves));
        program.set("first_query", first_query);
        collision.run(program, slot);
        gl::barrier(gl::Barrier::storage);  // both add to the same buffers
    };
    run(of_nodes, buffers.node_tasks, dispatch_slots::kNodeTasks, 0);
    run(of_edges, buffers.edge_tasks, dispatch_slots::kEdgeTasks, buffers.node_count);
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
    begin_program_.bind("Dispatches", collision.dispatches);
    begin_program_.bind("Starts", buffers.starts);
    begin_program_.bind("Found", buffers.found);
    begin_program_.set("query_count", buffers.query_count);
    begin_program_.dispatch(buffers.query_count + 1);
    gl::barrier(gl::Barrier::storage);

    for (const gl::Program* program :
         {&object_program_, &count_program_, &task_program_, &list_program_, &test_nodes_program_,
          &test_edges_program_, &write_nodes_program_, &write_edges_program_}) {
        program->bind("positions", nodes.position_texels);
        program->bind("tree_nodes", collision.face_trees.node_texels);
        program->bind("tree_boxes", collision.face_trees.box_texels);
        program->bind("faces", model.face_texels);
        program->bind("Dispatches", collision.dispatches);
        buffers.bind_surface(*program);
    }
    find_near_leaves(collision, buffers);
    test(collision, buffers);
    sum_up(buffers);
    write(collision, buffers);
}

void FindProximities::find_near_leaves(const CollisionBuffers& collision,
                                       const ProximityBuffers& buffers) const {
    for (const gl::Program* program : {&object_program_, &count_program_, &task_program_, &list_program_}) {
        program->bind("LeafSearches", buffers.searches);
        program->bind("NearObjects", buffers.near_objects);
    }
    for (const gl::Program* program : {&count_program_, &list_program_}) {
        program->bind("roots", collision.face_trees.root_texels);
        program->bind("NearLeaves", buffers.near_leaves);
    }
    collision.bind_pairs(object_program_);
    object_program_.set("search_count", buffers.leaf_count);
    object_program_.set("near_object_capacity", capacity(buffers.near_objects));
    object_program_.dispatch(buffers.leaf_count);
    gl::barrier(kNext);

    count_program_.set("near_object_capacity", capacity(buffers.near_objects));
    collision.run(count_program_, dispatch_slots::kNearObjects);
    gl::barrier(kNext);

    task_program_.bind("NodeTasks", buffers.node_tasks.leaves);
    task_program_.bind("EdgeTasks", buffers.edge_tasks.leaves);
    task_program_.set("search_count", buffers.leaf_count);
    task_program_.set("near_leaf_capacity", capacity(buffers.near_leaves));
    task_program_.set("node_task_capacity", capacity(buffers.node_tasks.leaves));
    task_program_.set("edge_task_capacity", capacity(buffers.edge_tasks.leaves));
    task_program_.dispatch(buffers.leaf_count);
    gl::barrier(kNext);

    list_program_.set("near_object_capacity", capacity(buffers.near_objects));
    collision.run(list_program_, dispatch_slots::kNearObjects);
    gl::barrier(gl::Barrier::texture_fetch);
}

void FindProximities::test(const CollisionBuffers& collision, const ProximityBuffers& buffers) const {
    run_tasks(test_nodes_program_, test_edges_program_, collision, buffers);
}

void FindProximities::sum_up(const ProximityBuffers& buffers) const {
    for (const gl::Program* program : {&sum_program_, &sum_groups_program_, &start_program_}) {
        program->bind("Found", buffers.found);
        program->bind("GroupSums", buffers.group_sums);
        program->bind("Starts", buffers.starts);
        program->set("query_count", buffers.query_count);
        program->set("node_count", buffers.node_count);
    }
    constexpr std::uint32_t kGroup = packing::kQueriesAGroup;
    sum_program_.dispatch_groups((buffers.query_count + kGroup - 1) / kGroup);
    gl::barrier(gl::Barrier::storage);
    sum_groups_program_.dispatch_groups(1);
    gl::barrier(gl::Barrier::storage);
    start_program_.dispatch(buffers.query_count + 1);
    gl::barrier(gl::Barrier::storage);
}

void FindProximities::write(const CollisionBuffers& collision, const ProximityBuffers& buffers) const {
    for (const gl::Program* program : {&write_nodes_program_, &write_edges_program_}) {
        program->bind("Proximities", buffers.proximities);
        program->bind("Found", buffers.found);
        program->set("proximity_capacity", capacity(buffers.proximities));
    }
    run_tasks(write_nodes_program_, write_edges_program_, collision, buffers);
}

}  // namespace gelatin::gpu
