// Which faces of a task's leaves are nearer to its node than the radius, or with EDGES which edges to its edge: the bits of
// `hits`, and how many in all of a node's or an edge's tasks.
// CPU twin: gelatin::cpu::FindProximities. Parity: tests/gpu/proximity/find_proximities_test.cpp.
#include "sim/proximity/proximity_task.glsl"
layout(local_size_x = 64) in;

layout(std430) writeonly buffer Hits { uvec4 hits[]; };
layout(std430) buffer Starts { uint starts[]; };  // counts of the queries: nodes, then edges
uniform float squared_radius;
uniform uint first_query;

void main() {
    uint t = global_index();
    if (t >= min(dispatches[kTasks].count, task_capacity) || task_leaves[t] == kNone) return;
    Task task = fetch_task(t);
#ifdef EDGES
    uint query = task.place;
    uvec4 edge = texelFetch(face_edges, int(query));
    Bounds box = edge_bounds(position(edge.x), position(edge.y));
#else
    uint query = texelFetch(surface_nodes, int(task.place)).x;
    Bounds box = edge_bounds(position(query), position(query));
#endif
    uint near = 0u;  // leaves
    for (uint k = 0u; k < kLeavesATask; ++k) {
        uint leaf = texelFetch(near_leaves, int(task.first_near + min(k, task.near_count - 1u))).x;
        near |= uint(k < task.near_count && meet(box, tree_bounds(leaf))) << k;
    }
    uvec4 candidates = uvec4(0u);  // by boxes
    while (near != 0u) {
        uint k = uint(findLSB(near));
        near &= near - 1u;
        uvec3 leaf = texelFetch(tree_nodes, int(texelFetch(near_leaves, int(task.first_near + k)).x)).xyz;
        uint bits = 0u;
#ifdef EDGES
        uint first = first_parts(leaf.y).y, last = first_parts(leaf.y + leaf.z).y;
        for (uint other = first; other < last; ++other) {
            uvec4 ends = texelFetch(face_edges, int(other));
            bool share = any(equal(edge.xxyy, ends.xyxy));
            bits |= uint(!share && meet(box, edge_bounds(position(ends.x), position(ends.y)))) << (other - first);
        }
#else
        for (uint face = leaf.y; face < leaf.y + leaf.z; ++face) {
            bool is_corner = any(equal(texelFetch(faces, int(face)).xyz, uvec3(query)));
            bits |= uint(!is_corner && meet(box, face_bounds(face))) << (face - leaf.y);
        }
#endif
        candidates[k / 2u] |= bits << (16u * (k % 2u));
    }
    uvec4 found = uvec4(0u);
    while (any_bit(candidates)) {
        uint bit = take_bit(candidates);
        Nearest nearest = nearest_to(query, first_of_leaf(task, bit / 16u) + bit % 16u);
        found[bit / 32u] |= uint(nearest.points.squared_distance < squared_radius) << (bit % 32u);
    }
    hits[t] = found;
    ivec4 count = bitCount(found);
    uint sum = uint(count.x + count.y + count.z + count.w);
    if (sum > 0u) atomicAdd(starts[first_query + task.place], sum);
}
