// Compiled twice: as GLSL (std430) and as C++ (src/model/layouts.h).
// A node of the boundary, or a point of a skin, as it is drawn: those on a crease of the rest shape have one for each smooth side.
struct SurfaceVertex {   // 16 bytes
    uint  node;          // index of the node or point
    uint  object;
    uint  first_face;    // its faces are vertex_faces[first_face .. first_face + face_count)
    uint  face_count;    // >= 1
};
