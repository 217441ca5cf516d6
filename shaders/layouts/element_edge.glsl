// Compiled twice: as GLSL (std430) and as C++ (src/model/layouts.h).
// Two nodes of one body that elements join (src/model/elasticity/element_edges.h), and a spring between them or none.
struct ElementEdge {     // 16 bytes
    uint  lower;
    uint  upper;
    float rest_length;   // [m], 0 without a spring
    float stiffness;     // [N/m]
};
// What the elements of an edge add to the stiffness K of a step, as a matrix M: (K d)_lower has M (d_lower - d_upper), and the
// upper node the same with its transpose.
struct EdgeMatrix {      // 48 bytes
    vec4  x;             // its columns [N/m]; w: what the spring exerts on the lower node [N]
    vec4  y;
    vec4  z;
};
// What K has on its diagonal for a node.
struct NodeBlock {       // 32 bytes
    vec4  diagonal;      // xx, yy, zz [N/m]
    vec4  beside;        // yz, zx, xy
};
