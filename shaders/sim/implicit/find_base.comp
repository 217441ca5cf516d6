// What all but rows and elements exert on bodies of large islands as rigid ones where a solve begins, by chunk; with FINISH: where it
// ends, elements among it, and the displacements there.
// CPU twin: gelatin::cpu::IslandSolve::gather_base. Parity: tests/gpu/implicit/step_system_test.cpp.
const uint kLanes = 64u;
#include "sim/implicit/solve_system.glsl"
#include "sim/implicit/base_sums.glsl"
#include "sim/implicit/body_sums.glsl"
layout(local_size_x = 64) in;

#ifdef FINISH
uniform samplerBuffer parts;     // of each island's step, that it makes
uniform samplerBuffer steps;     // [m]
uniform samplerBuffer bases;     // without rows [N]
uniform samplerBuffer products;  // by how much less that is after the step [N]
layout(std430) buffer Displacements { vec4 displacements[]; };  // d [m]

vec3 base_at(uint n, uint island, vec4 load) {
    float part = texelFetch(parts, int(island)).x;
    displacements[n].xyz += part * texelFetch(steps, int(n)).xyz;
    return texelFetch(bases, int(n)).xyz - part * texelFetch(products, int(n)).xyz;
}
#else
uniform samplerBuffer displacements;  // d, xyz [m]

vec3 base_at(uint n, uint island, vec4 load) { return first_base(load, texelFetch(displacements, int(n)).xyz); }
#endif

void main() {
    uint c = group_index();
    if (c >= chunk_count) return;
    uint island = large_island_of(texelFetch(chunks, int(c)).x);
    if (island != kNone) sum_base(c, island);
}
