// What gpu::CullByDepth has left: faces and objects that are hidden in each of VIEW_COUNT views. Where VIEW_COUNT is not
// defined nothing was culled.
#ifdef VIEW_COUNT
uniform usamplerBuffer face_views;    // the last view that the face was hidden in, from 1; 0: none
uniform usamplerBuffer object_views;  // the same of any of its faces

bool face_may_collide(uint face) { return texelFetch(face_views, int(face)).x == uint(VIEW_COUNT); }
bool object_may_collide(uint object) { return texelFetch(object_views, int(object)).x == uint(VIEW_COUNT); }
#else
bool face_may_collide(uint face) { return true; }
bool object_may_collide(uint object) { return true; }
#endif
