// A box round what 64 invocations have.
#include "layouts/box.glsl"
layout(local_size_x = 64) in;

shared Box box_parts[64];

Box empty_box() { return Box(vec4(3.4e38), vec4(-3.4e38)); }
Box join(Box a, Box b) { return Box(min(a.min, b.min), max(a.max, b.max)); }

// To be called by the whole work group; the first invocation has the result.
Box reduce_box(Box box) {
    box_parts[gl_LocalInvocationID.x] = box;
    barrier();
    if (gl_LocalInvocationID.x == 0u) {
        for (uint l = 1u; l < 64u; ++l) box = join(box, box_parts[l]);
    }
    return box;
}
