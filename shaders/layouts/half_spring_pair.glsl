// Compiled twice: as GLSL (std430) and as C++ (src/model/layouts.h).
// Two springs as one of their endpoints sees them; one RGBA32UI texel. Their stiffnesses lie beside it, in one
// RG32F texel of the same index. A pair that is not full is padded with {the node itself, 0} and stiffness 0.
struct HalfSpringPair {  // 16 bytes
    uint  node_0;        // the other endpoint, index into node_positions
    float rest_length_0; // [m]
    uint  node_1;
    float rest_length_1;
};
