// Vectors of a z-up scene with y up: turned by -90 degrees about x, as to_y_up does (src/render/up_axis.h).
// Test: tests/render/up_axis_test.cpp.
#include "include/global_index.glsl"
layout(local_size_x = 64) in;

uniform samplerBuffer vectors;
layout(std430) writeonly buffer Turned { vec4 turned[]; };
uniform uint vector_count;

void main() {
    uint v = global_index();
    if (v >= vector_count) return;
    vec4 vector = texelFetch(vectors, int(v));
    turned[v] = vec4(vector.x, vector.z, -vector.y, vector.w);
}
