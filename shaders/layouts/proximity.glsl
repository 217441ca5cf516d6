// Compiled twice: as GLSL (std430) and as C++ (src/model/layouts.h).
struct FaceEdge {        // 16 bytes
    uint  a;             // nodes, a < b
    uint  b;
    uint  object;
    uint  face;          // that owns it: the first that has it
};
// A node and a face, or two edges, nearer than the radius. Where they are nearest follows from the weights.
struct Proximity {       // 48 bytes
    uint  first;         // node, or edge
    uint  second;        // face, or edge
    float distance;      // [m], >= 0
    uint  unused;
    vec4  apart;         // from the first one's nearest point to the second's, xyz [m]
    vec4  weights;       // node and face: of the face's corners, 0; edges: 1 - s, s, 1 - t, t of their ends
};
struct ProximityCounts { // 16 bytes
    uint  node_face;     // found, written or not
    uint  all;           // and of two edges, each pair twice
    uint  nearest;       // bits of the least distance [m]; those of infinity where there is none
    uint  unused;
};
// What a leaf of a face tree, whose nodes and edges search together, has found on the way. A task is a node or an edge
// and up to eight of the leaves that are near.
struct LeafSearch {      // 32 bytes
    uint  first_object;  // in the list of objects that it may be near to
    uint  object_count;
    uint  first_near;    // in the list of leaves that are near
    uint  near_count;
    uint  first_node_task;
    uint  first_edge_task;
    uint  unused_0;
    uint  unused_1;
};
// A leaf's walk through the tree of an object.
struct NearObject {      // 16 bytes
    uint  leaf;
    uint  object;
    uint  first_near;    // in the list of leaves that are near
    uint  near_count;
};
