// Compiled twice: as GLSL (std430) and as C++ (src/model/layouts.h).
struct Spring {          // 16 bytes
    uint  i;             // first endpoint, index into node_positions
    uint  j;             // second endpoint, != i
    float rest_length;   // [m], > 0
    float stiffness;     // [N/m], >= 0
};
