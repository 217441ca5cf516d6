// Input of the kernels of gpu::FindProximities: leaves of the face trees, whose nodes and edges search together.
#include "sim/collision/box_margin.glsl"
#include "sim/collision/dispatches.glsl"
#include "include/global_index.glsl"
#include "layouts/proximity.glsl"

uniform samplerBuffer positions;     // xyz [m]
uniform usamplerBuffer tree_nodes;   // TreeNode
uniform samplerBuffer tree_boxes;    // Box
uniform usamplerBuffer faces;        // Face
uniform samplerBuffer face_boxes;    // Box
uniform usamplerBuffer leaf_nodes;   // of the trees, by leaf
uniform usamplerBuffer face_starts;  // of each face in surface_nodes and face_edges
uniform usamplerBuffer surface_nodes;
uniform usamplerBuffer face_edges;   // FaceEdge

Bounds tree_bounds(uint node) {
    return Bounds(texelFetch(tree_boxes, int(2u * node)).xyz, texelFetch(tree_boxes, int(2u * node + 1u)).xyz);
}
Bounds face_bounds(uint face) {
    return Bounds(texelFetch(face_boxes, int(2u * face)).xyz, texelFetch(face_boxes, int(2u * face + 1u)).xyz);
}

vec3 position(uint node) { return texelFetch(positions, int(node)).xyz; }

// With the margin; bits as those of shaders/sim/collision/update_boxes.comp.
Bounds edge_bounds(vec3 a, vec3 b) {
    return Bounds(min(a - margin_at(a), b - margin_at(b)), max(a + margin_at(a), b + margin_at(b)));
}

// A leaf's skip, first face, number of faces.
uvec3 fetch_leaf(uint leaf) { return texelFetch(tree_nodes, int(texelFetch(leaf_nodes, int(leaf)).x)).xyz; }

// The nodes (x) or edges (y) that faces first ... end - 1 own.
uvec2 first_parts(uint face) { return texelFetch(face_starts, int(face)).xy; }

const uint kLeavesATask = 8u;
