// Compiled twice: as GLSL (std430) and as C++ (src/model/layouts.h).
// Arguments of an indirect dispatch, and how many of its invocations have work.
struct Dispatch {        // 16 bytes
    uint  groups_x;
    uint  groups_y;
    uint  groups_z;
    uint  count;
};
