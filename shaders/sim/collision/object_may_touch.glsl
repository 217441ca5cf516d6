// The paper's first test (2.4): bounding box against bounding box; and a search for all objects that pass it.
#include "sim/depth/hidden.glsl"
#include "sim/collision/pairs.glsl"
uniform uint object_count;
uniform uint ignore_boxes;  // 1: every object may touch every other

bool may_touch(uint a, uint b) {
    BoundingBox box_a = bounding_boxes[a];
    BoundingBox box_b = bounding_boxes[b];
    bool near = meet(box_a.min.xyz, box_a.max.xyz, box_b.min.xyz, box_b.max.xyz);
    return a != b && (near || ignore_boxes != 0u) && object_may_collide(b);
}

#ifdef OBJECT_TREE
uniform usamplerBuffer object_tree_nodes;  // TreeNode
uniform samplerBuffer object_tree_boxes;   // Box
uniform usamplerBuffer object_order;

// A walk through the tree over all objects: the next node, and what is left of the leaf before it.
struct Search {
    uint object;
    uint node;
    uint item;
    uint last_item;
};

// The next object that may touch Search::object, or kNone after the last; in no particular order.
uint next_partner(inout Search search) {
    BoundingBox box = bounding_boxes[search.object];
    uint end = texelFetch(object_tree_nodes, 0).x;
    uint partner = kNone;
    while (partner == kNone && (search.item < search.last_item || search.node < end)) {
        if (search.item < search.last_item) {
            uint other = texelFetch(object_order, int(search.item)).x;
            ++search.item;
            if (may_touch(search.object, other)) partner = other;
        } else {
            uvec4 node = texelFetch(object_tree_nodes, int(search.node));
            bool near = meet(box.min.xyz, box.max.xyz, texelFetch(object_tree_boxes, int(2u * search.node)).xyz,
                             texelFetch(object_tree_boxes, int(2u * search.node + 1u)).xyz);
            search.node = near ? search.node + 1u : node.x;
            search.item = node.y;
            search.last_item = node.y + (near ? node.z : 0u);
        }
    }
    return partner;
}
Search start_search(uint object) { return Search(object, 0u, 0u, 0u); }
#else
struct Search {
    uint object;
    uint other;
};
uint next_partner(inout Search search) {
    while (search.other < object_count && !may_touch(search.object, search.other)) ++search.other;
    return search.other < object_count ? search.other++ : kNone;
}
Search start_search(uint object) { return Search(object, object_may_collide(object) ? 0u : object_count); }
#endif
