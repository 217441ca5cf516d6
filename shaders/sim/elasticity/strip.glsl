// Walks along the strip of tets round a node (layouts/tet_strip.glsl).
#include "layouts/packing.glsl"
#include "layouts/tet_strip.glsl"

// Values at the last three vertices, the oldest first.
struct Strip {
    vec3 a, b, c;
};

const Strip kNoStrip = Strip(vec3(0.0), vec3(0.0), vec3(0.0));

// @param vertex of a step @param next the value there
void step_strip(uint vertex, vec3 next, inout Strip strip) {
    strip.a = (vertex & 0x80000000u) != 0u ? strip.a : strip.b;
    strip.b = strip.c;
    strip.c = next;
}

// The same of a number at each vertex.
void step_numbers(uint vertex, float next, inout vec3 numbers) {
    numbers = vec3((vertex & 0x80000000u) != 0u ? numbers.x : numbers.y, numbers.z, next);
}

float sum_of(vec3 numbers) { return numbers.x + numbers.y + numbers.z; }

int node_of(uint vertex) { return int(vertex & 0x7FFFFFFFu); }
