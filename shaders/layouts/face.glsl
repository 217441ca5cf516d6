// Compiled twice: as GLSL (std430) and as C++ (src/model/layouts.h).
struct Face {            // 16 bytes
    uint  a;             // nodes, counter-clockwise seen from outside
    uint  b;
    uint  c;
    uint  object;
};
