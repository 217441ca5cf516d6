// A face's walk through the tree of its own object.
#include "sim/collision/dispatches.glsl"
#include "layouts/box.glsl"

uniform usamplerBuffer tree_nodes;  // TreeNode
uniform samplerBuffer tree_boxes;   // Box
uniform usamplerBuffer roots;       // nodes, by object
uniform usamplerBuffer faces;       // Face
layout(std430) readonly buffer FaceBoxes { Box face_boxes[]; };

struct OwnWalk {
    uvec4 face;  // its corners and object
    Box box;
    uint node;
    uint end;
};

OwnWalk start_walk(uint face) {
    uvec4 corners = texelFetch(faces, int(face));
    uint root = texelFetch(roots, int(corners.w)).x;
    return OwnWalk(corners, face_boxes[face], root, texelFetch(tree_nodes, int(root)).x);
}

// The next leaf that is near: its first face, and how many there are; 0 behind the last.
uvec2 next_leaf(inout OwnWalk walk) {
    uvec2 leaf = uvec2(0u);
    while (walk.node < walk.end && leaf.y == 0u) {
        uvec4 node = texelFetch(tree_nodes, int(walk.node));
        bool near = meet(walk.box.min.xyz, walk.box.max.xyz, texelFetch(tree_boxes, int(2u * walk.node)).xyz,
                         texelFetch(tree_boxes, int(2u * walk.node + 1u)).xyz);
        leaf = near ? node.yz : uvec2(0u);
        walk.node = near ? walk.node + 1u : node.x;
    }
    return leaf;
}

// True for a face whose box meets that of the face that walks, and that shares no corner with it.
bool is_near(OwnWalk walk, uint other) {
    uvec3 corners = texelFetch(faces, int(other)).xyz;
    bool neighbour = any(equal(walk.face.xxx, corners)) || any(equal(walk.face.yyy, corners)) ||
                     any(equal(walk.face.zzz, corners));
    Box box = face_boxes[other];
    return !neighbour && meet(walk.box.min.xyz, walk.box.max.xyz, box.min.xyz, box.max.xyz);
}
