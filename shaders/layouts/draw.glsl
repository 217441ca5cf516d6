// Compiled twice: as GLSL (std430) and as C++ (src/model/layouts.h).
// Arguments of an indirect draw without indices.
struct Draw {            // 16 bytes
    uint  count;         // of vertices
    uint  instance_count;
    uint  first;
    uint  first_instance;
};
