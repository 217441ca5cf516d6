// Compiled twice: as GLSL (std430) and as C++ (src/model/layouts.h).
// A tet of a neo-Hookean body as one of its corners sees it: four RGBA32UI texels. Energies do not depend on how the rest
// shape is rotated. So it is rotated such that the shape gradients of the other corners a, b and c are the columns of a
// triangular matrix: (aa, 0, 0), (ab, bb, 0), (ac, bc, cc) [1/m]. With d_a the vector from the corner to a, F has the columns
// aa d_a + ab d_b + ac d_c, bb d_b + bc d_c and cc d_c, and 6 V aa bb cc = 1.
struct NeoHookeanCorner {  // 64 bytes
    uint  node_a;          // counter-clockwise as seen from the corner, indices into node_positions
    uint  node_b;
    uint  node_c;
    uint  tet;             // of all tets; kNone pads
    float aa;
    float ab;
    float bb;
    float ac;
    float bc;
    float cc;
    float mu;              // times the volume at rest [J]
    float lambda;
    vec4  opening;         // mu V g, with g the corner's own shape gradient in the rest shape as it is [N]
};
