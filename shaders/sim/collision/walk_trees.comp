// The pairs of faces whose boxes meet, in no particular order: each candidate walks through the other object's tree.
// CPU twin: gelatin::cpu::Collision. Parity: tests/gpu/collision/collision_test.cpp.
#define WRITES_DISPATCHES
#include "sim/collision/pairs.glsl"
#include "sim/collision/face_pairs.glsl"
layout(local_size_x = 64) in;

uniform usamplerBuffer tree_nodes;  // TreeNode
uniform samplerBuffer tree_boxes;   // Box
uniform usamplerBuffer roots;       // nodes, by object

void main() {
    uint test = global_index();
    if (test >= dispatches[kTests].count) return;
    uint p = pair_of_test(test);
    ObjectPair pair = object_pairs[p];
    uint face = candidate(pair, test - pair.first_test);
    Box box = face_boxes[face];

    uint n = texelFetch(roots, int(pair.other)).x;
    uint end = texelFetch(tree_nodes, int(n)).x;
    while (n < end) {
        // To the next near leaf: a small separate loop, because most nodes are only passed.
        uvec4 node = uvec4(0u);
        bool at_leaf = false;
        while (n < end && !at_leaf) {
            node = texelFetch(tree_nodes, int(n));
            bool near = meet(box.min.xyz, box.max.xyz, texelFetch(tree_boxes, int(2u * n)).xyz,
                             texelFetch(tree_boxes, int(2u * n + 1u)).xyz);
            at_leaf = near && node.z != 0u;
            n = near ? n + 1u : node.x;
        }
        uint found = 0u;
        for (uint k = 0u; k < 4u; ++k) {
            bool near = meets_face(box, node.y + min(k, max(node.z, 1u) - 1u));
            found |= uint(at_leaf && k < node.z && near) << k;
        }
        add_face_pairs(p, face, node.y, found);
    }
}
