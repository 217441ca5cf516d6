// Compiled twice: as GLSL (std430) and as C++ (src/model/layouts.h).
// A tet of a neo-Hookean body: four RGBA32UI texels. Corner 0's shape function has minus the sum of the other
// gradients.
struct NeoHookeanTet {   // 64 bytes
    uint  node_0;        // corners, indices into node_positions
    uint  node_1;
    uint  node_2;
    uint  node_3;
    vec4  gradient_1;    // of corner 1's shape function at rest [1/m]; w: volume at rest [m^3]
    vec4  gradient_2;    // w: mu [Pa]
    vec4  gradient_3;    // w: lambda [Pa]
};
