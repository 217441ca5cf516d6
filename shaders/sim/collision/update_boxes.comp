// Boxes of the nodes of trees, one level in each dispatch, leaves first. LEAVES: nodes over faces, whose boxes are computed
// too. CONTINUOUS: boxes over the whole step; MARGIN: larger than the faces. OBJECTS: nodes over objects. Neither: inner nodes.
// The box of a face tree's root is its object's bounding box. CPU twin: gelatin::cpu::Collision. Parity:
// tests/gpu/collision/collision_test.cpp.
#include "layouts/packing.glsl"
#include "include/global_index.glsl"
#include "layouts/box.glsl"
#include "layouts/face.glsl"
#include "layouts/tree_node.glsl"
layout(local_size_x = 64) in;

uniform usamplerBuffer tree_nodes;  // TreeNode
uniform usamplerBuffer object_order;
layout(std430) buffer BoundingBoxes { BoundingBox bounding_boxes[]; };
layout(std430) buffer TreeBoxes { Box tree_boxes[]; };
layout(std430) readonly buffer LevelNodes { uint level_nodes[]; };
uniform uint first_node;  // of this level in level_nodes
uniform uint node_count;

Box join(Box a, Box b) { return Box(min(a.min, b.min), max(a.max, b.max)); }

#ifdef LEAVES
uniform samplerBuffer positions;           // xyz [m]
uniform samplerBuffer previous_positions;  // at the start of the step, xyz [m]
layout(std430) readonly buffer Faces { Face faces[]; };
layout(std430) writeonly buffer FaceBoxes { Box face_boxes[]; };

#ifdef MARGIN
#include "sim/collision/box_margin.glsl"
#endif

Box box_of_corners(Face face, samplerBuffer at) {
    vec3 a = texelFetch(at, int(face.a)).xyz;
    vec3 b = texelFetch(at, int(face.b)).xyz;
    vec3 c = texelFetch(at, int(face.c)).xyz;
#ifdef MARGIN
    vec3 low = min(a - margin_at(a), min(b - margin_at(b), c - margin_at(c)));
    vec3 high = max(a + margin_at(a), max(b + margin_at(b), c + margin_at(c)));
    return Box(vec4(low, 0.0), vec4(high, 0.0));
#else
    return Box(vec4(min(a, min(b, c)), 0.0), vec4(max(a, max(b, c)), 0.0));
#endif
}

Box box_of_face(uint f) {
    Box box = box_of_corners(faces[f], positions);
#ifdef CONTINUOUS
    box = join(box, box_of_corners(faces[f], previous_positions));
#endif
    return box;
}
#endif

void main() {
    uint index = global_index();
    if (index >= node_count) return;
    uint n = level_nodes[first_node + index];
    uvec4 node = texelFetch(tree_nodes, int(n));  // skip, first face, number of faces, object
    Box box = Box(vec4(3.4e38), vec4(-3.4e38));
#ifdef LEAVES
    for (uint f = node.y; f < node.y + node.z; ++f) {
        Box face_box = box_of_face(f);
        face_boxes[f] = face_box;
        box = join(box, face_box);
    }
#elif defined(OBJECTS)
    for (uint k = node.y; k < node.y + node.z; ++k) {
        BoundingBox object = bounding_boxes[texelFetch(object_order, int(k)).x];
        box = join(box, Box(object.min, object.max));
    }
#else
    uint child = n + 1u;
    while (child < node.x) {
        box = join(box, tree_boxes[child]);
        child = texelFetch(tree_nodes, int(child)).x;
    }
#endif
    tree_boxes[n] = box;
    if (node.w == kNone) return;
    bounding_boxes[node.w].min = box.min;
    bounding_boxes[node.w].max = box.max;
}
