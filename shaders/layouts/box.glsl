// Compiled twice: as GLSL (std430) and as C++ (src/model/layouts.h).
// An axis-aligned box; empty where min > max.
struct Box {             // 32 bytes
    vec4  min;           // xyz [m]
    vec4  max;           // xyz [m]
};
struct BoundingBox {     // 48 bytes; of an object (paper 3.1)
    vec4  min;           // xyz [m]
    vec4  max;           // xyz [m]
    uint  object;
    uint  node_count;
    uint  face_count;
    uint  first_face;
};
