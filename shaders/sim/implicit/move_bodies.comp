// Bodies of large islands move as rigid ones, a work group a chunk of nodes.
// CPU twin: gelatin::cpu::IslandSolve::rigid_newton. Parity: tests/gpu/implicit/step_system_test.cpp.
const uint kLanes = 64u;
#include "sim/implicit/solve_system.glsl"
#include "sim/implicit/move_nodes.glsl"
layout(local_size_x = 64) in;

uniform samplerBuffer motions;  // BodyMotion of each object, two texels

void main() {
    uint c = group_index();
    if (c >= chunk_count) return;
    uvec4 chunk = texelFetch(chunks, int(c));
    uint island = large_island_of(chunk.x);
    if (island == kNone || !has_rows(fetch_island(island))) return;
    move_nodes(chunk, BodyMotion(texelFetch(motions, 2 * int(chunk.x)), texelFetch(motions, 2 * int(chunk.x) + 1)));
}
