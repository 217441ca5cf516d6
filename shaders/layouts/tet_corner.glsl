// Compiled twice: as GLSL (std430) and as C++ (src/model/layouts.h).
// A tet as one of its corners sees it; one RGBA32UI texel. Padded with tet 0xFFFFFFFF.
struct TetCorner {       // 16 bytes
    uint  a;             // the other corners, counter-clockwise as this one sees them
    uint  b;
    uint  c;
    uint  tet;
};
