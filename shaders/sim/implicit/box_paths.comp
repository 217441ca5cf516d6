// Boxes of nodes of the face trees, over the paths of a part relative to the motion of their objects: one level in each dispatch, with
// LEAVES the first one. An invocation a node. CPU twin: gelatin::cpu::FindPairs. Parity: tests/gpu/implicit/find_pairs_test.cpp.
#include "include/global_index.glsl"
#include "layouts/box.glsl"
#include "sim/implicit/clock.glsl"
#include "sim/implicit/path_boxes.glsl"
layout(local_size_x = 64) in;

uniform usamplerBuffer tree_nodes;  // TreeNode
#ifdef LEAVES
uniform usamplerBuffer faces;       // Face
#endif
layout(std430) readonly buffer LevelNodes { uint level_nodes[]; };
layout(std430) buffer TreeBoxes { Box tree_boxes[]; };
uniform uint first_node;  // of this level in level_nodes
uniform uint node_count;

void main() {
    uint index = global_index();
    if (index >= node_count || clock[0].goes_on == 0u) return;
    uint n = level_nodes[first_node + index];
    uvec4 node = texelFetch(tree_nodes, int(n));  // skip, first face, number of faces
    Bounds box = Bounds(vec3(3.4e38), vec3(-3.4e38));
#ifdef LEAVES
    for (uint f = node.y; f < node.y + node.z; ++f) {
        uvec4 face = texelFetch(faces, int(f));
        box = joined(box, path_bounds(face.xyz, frame_of(face.w)));
    }
#else
    for (uint child = n + 1u; child < node.x; child = texelFetch(tree_nodes, int(child)).x)
        box = joined(box, Bounds(tree_boxes[child].min.xyz, tree_boxes[child].max.xyz));
#endif
    tree_boxes[n] = Box(vec4(box.min, 0.0), vec4(box.max, 0.0));
}
