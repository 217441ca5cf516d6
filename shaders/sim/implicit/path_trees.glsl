// The trees of boxes of objects, for searches of one in another.
#include "sim/implicit/path_boxes.glsl"

uniform usamplerBuffer tree_nodes;  // TreeNode
uniform samplerBuffer tree_boxes;   // Box
uniform usamplerBuffer roots;       // nodes, by object

Bounds tree_bounds(uint node) {
    return Bounds(texelFetch(tree_boxes, int(2u * node)).xyz, texelFetch(tree_boxes, int(2u * node + 1u)).xyz);
}
uint root_of(uint object) { return texelFetch(roots, int(object)).x; }
Bounds bounds_of(uint object) { return swept(tree_bounds(root_of(object)), motion_of(object)); }
