// Marks each face that touches another object, or with SELF_COLLISION its own. CPU twin: gelatin::cpu::Collision::collides. Parity:
// tests/gpu/view/mark_faces_test.cpp.
#include "sim/collision/pairs.glsl"
#include "sim/collision/face_collisions.glsl"
#include "layouts/face.glsl"
layout(local_size_x = 64) in;

layout(std430) readonly buffer Faces { Face faces[]; };
layout(std430) writeonly buffer Marks { uint marks[]; };
uniform uint face_count;

void main() {
    uint f = global_index();
    if (f >= face_count) return;
    marks[f] = uint(collides_with_any(pair_rows[faces[f].object], f));
}
