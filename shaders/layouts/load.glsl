// Compiled twice: as GLSL (std430) and as C++ (src/model/layouts.h).
// What a load does to a node: force, and the pressure on its third of the face node, b, c.
struct NodeLoad {        // 32 bytes
    vec4  force;         // [N]; w: a sixth of the pressure [Pa]
    uint  load;
    uint  b;             // the face's other corners, counter-clockwise from outside; both the node itself where
    uint  c;             // there is no face
    uint  unused;
};
// A node and its loads.
struct LoadedNode {      // 16 bytes
    uint  node;
    uint  first;         // its NodeLoads
    uint  end;
    uint  unused;
};
