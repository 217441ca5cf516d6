// Bodies move as rigid ones, a work group a chunk of nodes.
// CPU twin: gelatin::cpu::IslandSolve::rigid_newton. Parity: tests/gpu/implicit/step_system_test.cpp.
#include "sim/implicit/solve_system.glsl"
layout(local_size_x = 64) in;

uniform samplerBuffer motions;                                  // BodyMotion of each object, two texels
layout(std430) buffer Displacements { vec4 displacements[]; };  // d [m]

void main() {
    uint c = group_index();
    if (c >= chunk_count) return;
    uvec4 chunk = texelFetch(chunks, int(c));
    uint island = texelFetch(island_of_object, int(chunk.x)).x;
    if (island == kNone || !has_rows(fetch_island(island)) || !(texelFetch(bodies, 5 * int(chunk.x)).w > 0.0)) return;
    BodyMotion motion = BodyMotion(texelFetch(motions, 2 * int(chunk.x)), texelFetch(motions, 2 * int(chunk.x) + 1));
    vec3 center = center_of(chunk.x);
    for (uint n = chunk.y + gl_LocalInvocationID.x; n < chunk.y + chunk.z; n += 64u)
        displacements[n].xyz += at_node(motion, center, n);
}
