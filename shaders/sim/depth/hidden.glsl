// The faces and objects that gpu::CullByDepth has left: those that are hidden in each of VIEW_COUNT views. In place of
// sim/collision/may_collide.glsl.
#define FACE_FILTER
uniform usamplerBuffer face_views;    // the last view that the face was hidden in, from 1; 0: none
uniform usamplerBuffer object_views;  // the same of any of its faces

bool face_may_collide(uint face) { return texelFetch(face_views, int(face)).x == uint(VIEW_COUNT); }
bool object_may_collide(uint object) { return texelFetch(object_views, int(object)).x == uint(VIEW_COUNT); }
