// Which faces and objects may touch another object at all: all, unless a shader that includes this one defines FACE_FILTER and
// brings both functions along (gpu::FaceFilter).
#ifndef FACE_FILTER
bool face_may_collide(uint face) { return true; }
bool object_may_collide(uint object) { return true; }
#endif
