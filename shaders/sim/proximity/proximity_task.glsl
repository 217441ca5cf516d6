// A task: a node, or with EDGES an edge, and up to eight leaves. What it has found are bits in four words, two leaves a
// word, sixteen bits a leaf, by the leaf's faces or edges.
#include "sim/collision/nearest_points.glsl"
#include "sim/proximity/proximities.glsl"

layout(std430) readonly buffer LeafSearches { LeafSearch searches[]; };
uniform usamplerBuffer near_leaves;  // nodes of the trees
layout(std430) readonly buffer Tasks { uint task_leaves[]; };
uniform uint task_capacity;

#ifdef EDGES
const uint kTasks = kEdgeTasks;
#else
const uint kTasks = kNodeTasks;
#endif

struct Task {
    uint place;       // of the node in surface_nodes, or of the edge
    uint chunk;       // eighths of the leaves before
    uint first_near;  // its leaves in near_leaves
    uint near_count;
};

Task fetch_task(uint t) {
    uint leaf = task_leaves[t];
    LeafSearch search = searches[leaf];
    uint chunks = (search.near_count + kLeavesATask - 1u) / kLeavesATask;
    uvec2 first = first_parts(fetch_leaf(leaf).y);
#ifdef EDGES
    uint place = first.y + (t - search.first_edge_task) / chunks, chunk = (t - search.first_edge_task) % chunks;
#else
    uint place = first.x + (t - search.first_node_task) / chunks, chunk = (t - search.first_node_task) % chunks;
#endif
    return Task(place, chunk, search.first_near + chunk * kLeavesATask,
                min(search.near_count - chunk * kLeavesATask, kLeavesATask));
}

// The first face, or edge, of one of a task's leaves.
uint first_of_leaf(Task task, uint k) {
    uint face = texelFetch(tree_nodes, int(texelFetch(near_leaves, int(task.first_near + k)).x)).y;
#ifdef EDGES
    return first_parts(face).y;
#else
    return face;
#endif
}

// Takes the lowest bit out of four words: 32 times the word's number, and the bit's.
uint take_bit(inout uvec4 words) {
    uint w = words.x != 0u ? 0u : words.y != 0u ? 1u : words.z != 0u ? 2u : 3u;
    uint word = words[w];
    words[w] = word & (word - 1u);
    return 32u * w + uint(findLSB(word));
}
bool any_bit(uvec4 words) { return (words.x | words.y | words.z | words.w) != 0u; }

// What is nearest, as CPU and GPU compute it; edges in the order of their numbers, so that both are told the same.
#ifdef EDGES
struct Nearest {
    EdgeToEdge points;
};
Nearest nearest_to(uint edge, uint other) {
    uvec4 e = texelFetch(face_edges, int(min(edge, other))), f = texelFetch(face_edges, int(max(edge, other)));
    return Nearest(edge_to_edge(position(e.x), position(e.y), position(f.x), position(f.y)));
}
#else
struct Nearest {
    NodeToFace points;
};
Nearest nearest_to(uint node, uint face) {
    uvec4 f = texelFetch(faces, int(face));
    return Nearest(node_to_face(position(node), mat3(position(f.x), position(f.y), position(f.z))));
}
#endif
