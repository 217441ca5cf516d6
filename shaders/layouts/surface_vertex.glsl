// Compiled twice: as GLSL (std430) and as C++ (src/model/layouts.h).
// A surface node as it is drawn: nodes on a crease of the rest shape have one for each smooth side.
struct SurfaceVertex {   // 16 bytes
    uint  node;          // index into node_positions
    uint  object;
    uint  first_face;    // its faces are vertex_faces[first_face .. first_face + face_count)
    uint  face_count;    // >= 1
};
