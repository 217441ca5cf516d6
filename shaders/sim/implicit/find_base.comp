// What all but rows and elements exert on bodies as rigid ones where a solve begins, by chunk; with FINISH: where it ends, elements
// among it, and the displacements there.
// CPU twin: gelatin::cpu::IslandSolve::gather_base. Parity: tests/gpu/implicit/step_system_test.cpp.
#include "sim/implicit/solve_system.glsl"
#include "sim/implicit/body_sums.glsl"
layout(local_size_x = 64) in;

layout(std430) writeonly buffer BaseSums { ResidualSums base_sums[]; };
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

vec3 base_at(uint n, uint island, vec4 load) { return load.xyz - load.w * texelFetch(displacements, int(n)).xyz; }
#endif

void main() {
    uint c = group_index(), lane = gl_LocalInvocationID.x;
    if (c >= chunk_count) return;
    uvec4 chunk = texelFetch(chunks, int(c));
    uint island = texelFetch(island_of_object, int(chunk.x)).x;
    if (island == kNone) return;
    vec3 center = center_of(chunk.x), force = vec3(0.0), moment = vec3(0.0);
    for (uint n = chunk.y + lane; n < chunk.y + chunk.z; n += 64u) {
        vec4 load = texelFetch(loads, int(n));
        if (!(load.w > 0.0)) continue;
        vec3 base = base_at(n, island, load);
        force += base;
        moment += cross(texelFetch(positions, int(n)).xyz - center, base);
    }
    ResidualSums sum = sum_by_lanes(vec4(force, 0.0), moment);
    if (lane == 0u) base_sums[c] = sum;
}
