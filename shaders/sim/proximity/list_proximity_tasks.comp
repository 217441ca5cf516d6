// Where the leaves near each leaf are listed, and the tasks of its nodes and edges: each with eight of these leaves, in this
// order. CPU twin: gelatin::cpu::FindProximities. Parity: tests/gpu/proximity/find_proximities_test.cpp.
#define WRITES_DISPATCHES
#include "sim/proximity/proximities.glsl"
layout(local_size_x = 64) in;

layout(std430) buffer LeafSearches { LeafSearch searches[]; };
layout(std430) buffer NearObjects { NearObject near_objects[]; };
layout(std430) writeonly buffer NodeTasks { uint node_tasks[]; };  // leaves
layout(std430) writeonly buffer EdgeTasks { uint edge_tasks[]; };  // the same
uniform uint search_count;
uniform uint near_leaf_capacity;
uniform uint node_task_capacity;
uniform uint edge_task_capacity;

void main() {
    uint leaf = global_index();
    if (leaf >= search_count) return;
    LeafSearch search = searches[leaf];
    if (search.object_count == 0u) return;
    uint last = search.first_object + search.object_count;
    uint count = 0u;
    for (uint k = search.first_object; k < last; ++k) count += near_objects[k].near_count;
    uint left_over;
    uint first = take_slots(kNearLeaves, count, near_leaf_capacity, left_over);
    if (first == kNone) return;
    uint next = first;
    for (uint k = search.first_object; k < last; ++k) {
        near_objects[k].first_near = next;
        next += near_objects[k].near_count;
    }

    uvec3 faces_of_leaf = fetch_leaf(leaf);
    uvec2 parts = first_parts(faces_of_leaf.y + faces_of_leaf.z) - first_parts(faces_of_leaf.y);
    uvec2 tasks = parts * ((count + kLeavesATask - 1u) / kLeavesATask);
    uint first_node_task = take_slots(kNodeTasks, tasks.x, node_task_capacity, left_over);
    for (uint k = 1u; k <= left_over; ++k) node_tasks[node_task_capacity - k] = kNone;
    for (uint k = 0u; first_node_task != kNone && k < tasks.x; ++k) node_tasks[first_node_task + k] = leaf;
    uint first_edge_task = take_slots(kEdgeTasks, tasks.y, edge_task_capacity, left_over);
    for (uint k = 1u; k <= left_over; ++k) edge_tasks[edge_task_capacity - k] = kNone;
    for (uint k = 0u; first_edge_task != kNone && k < tasks.y; ++k) edge_tasks[first_edge_task + k] = leaf;
    searches[leaf] = LeafSearch(search.first_object, search.object_count, first, count, first_node_task, first_edge_task,
                                0u, 0u);
}
