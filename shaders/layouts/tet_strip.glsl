// Compiled twice: as GLSL (std430) and as C++ (src/model/layouts.h).
// Steps along the strip of tets round a node (src/model/elasticity/link_strip.h). With each a vertex comes in, which mostly
// completes a tet with the two vertices before it and the node: its corners a, b and c, with d_a the vector from the node to a.
struct VolumeStep {      // 16 bytes, one RGBA32UI texel
    uint  vertex;        // index into node_positions; bit 31: of the three vertices before, the oldest stays, not the second; kNone pads
    uint  tet;           // that it completes, of all tets; kNone if none
    float inverse_six_volumes;  // 1 / (6 V) [1/m^3], V at rest; negative if a, b, c are clockwise as seen from the node; 0 without a tet
    float modulus;       // of the tet's VolumeBound [J]; 0 without a tet
};
// Neo-Hookean energies do not depend on how the rest shape is rotated or mirrored. So it is such that the shape gradients of
// a, b and c are the columns of a triangular matrix: (aa, 0, 0), (ab, bb, 0), (ac, bc, cc) [1/m]. F has the columns
// aa d_a + ab d_b + ac d_c, bb d_b + bc d_c and cc d_c. 6 V aa bb cc is 1, or -1 if a, b, c are clockwise. All is 0 without a tet.
struct NeoHookeanStep {  // 64 bytes, four RGBA32UI texels
    uint  vertex;        // as above
    uint  tet;
    float mu;            // times V [J]
    float lambda;
    float aa;
    float ab;
    float bb;
    float ac;
    float bc;
    float cc;
    float modulus;       // as above
    float volume;        // V [m^3]
    vec4  opening;       // mu V g, with g the node's own shape gradient in the rest shape as it is [N]
};
