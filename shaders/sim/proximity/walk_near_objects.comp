// A leaf's walk through the tree of an object that may be near: how many of its leaves are, or with LIST which, in their
// order. One invocation a walk. CPU twin: gelatin::cpu::for_leaves_near. Parity: tests/gpu/proximity/find_proximities_test.cpp.
#include "sim/proximity/proximities.glsl"
layout(local_size_x = 64) in;

layout(std430) readonly buffer LeafSearches { LeafSearch searches[]; };
layout(std430) buffer NearObjects { NearObject near_objects[]; };
layout(std430) writeonly buffer NearLeaves { uint near_leaves[]; };  // nodes of the trees
uniform usamplerBuffer roots;                                 // nodes, by object
uniform uint near_object_capacity;

void main() {
    uint k = global_index();
    if (k >= min(dispatches[kNearObjects].count, near_object_capacity)) return;
    NearObject near_object = near_objects[k];
    if (near_object.leaf == kNone) return;
    Bounds box = tree_bounds(texelFetch(leaf_nodes, int(near_object.leaf)).x);
    uint n = texelFetch(roots, int(near_object.object)).x;
    uint end = texelFetch(tree_nodes, int(n)).x;
    uint count = 0u;
#ifdef LIST
    if (searches[near_object.leaf].near_count == 0u || near_object.near_count == 0u) return;
#endif
    while (n < end) {
        uvec4 node = texelFetch(tree_nodes, int(n));
        bool near = meet(box, tree_bounds(n));
        bool found = near && node.z != 0u;
#ifdef LIST
        if (found) near_leaves[near_object.first_near + count] = n;
#endif
        count += uint(found);
        n = near ? n + 1u : node.x;
    }
#ifndef LIST
    near_objects[k].near_count = count;
#endif
}
