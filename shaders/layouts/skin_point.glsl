// Compiled twice: as GLSL (std430) and as C++ (src/model/layouts.h).
// A point of a skin, which is at the sum of the positions of a tet's nodes, each with its weight.
struct SkinPoint {       // 32 bytes
    uint  a;             // indices into node_positions
    uint  b;
    uint  c;
    uint  d;
    vec4  weights;       // of a, b, c and d; their sum is 1; some are negative outside the tet
};
