// Bodies in the order of islands, each of which has the number of its first body. An invocation a body, which counts those before it.
// CPU twin: gelatin::cpu::Islands. Parity: tests/gpu/implicit/pair_rows_test.cpp.
#include "include/global_index.glsl"
#include "sim/implicit/near_pairs.glsl"
layout(local_size_x = 64) in;

uniform usamplerBuffer labels;  // the least body of each one's island
layout(std430) writeonly buffer IslandBodies { uint island_bodies[]; };

void main() {
    uint o = global_index(), before = 0u;
    if (o >= body_count) return;
    uint own = texelFetch(labels, int(o)).x;
    for (uint p = 0u; p < body_count; ++p) {
        uint label = texelFetch(labels, int(p)).x;
        if (label < own || (label == own && p < o)) ++before;
    }
    island_bodies[before] = o;
}
