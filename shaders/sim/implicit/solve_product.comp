// A p for the direction p of an iteration, rows in it; by chunk p . A p, and what A p is on bodies as rigid ones.
// CPU twin: gelatin::cpu::IslandSolve::multiply_direction. Parity: tests/gpu/implicit/step_system_test.cpp.
#define PRODUCTS
#include "sim/implicit/solve_system.glsl"
#include "sim/implicit/body_sums.glsl"
#include "sim/implicit/node_system.glsl"
layout(local_size_x = 64) in;

layout(std430) readonly buffer States { SolveState states[]; };
layout(std430) writeonly buffer Products { vec4 products[]; };      // [N]
layout(std430) writeonly buffer ProductSums { ResidualSums product_sums[]; };  // by chunk
#ifdef ROWS
vec3 row_value(uint r, StepRow row) { return times(row_stiffness(r), relative(row, displacements)); }
#endif

void main() {
    uint c = group_index(), lane = gl_LocalInvocationID.x;
    if (c >= chunk_count) return;
    uvec4 chunk = texelFetch(chunks, int(c));
    uint island = large_island_of(chunk.x);
    if (island == kNone || states[state_before(island)].is_done != 0u) return;
    vec3 center = center_of(chunk.x), moment = vec3(0.0);
    vec4 force = vec4(0.0);
    for (uint n = chunk.y + lane; n < chunk.y + chunk.z; n += 64u) {
        float inertia = texelFetch(loads, int(n)).w;
        vec3 p = texelFetch(displacements, int(n)).xyz, product = vec3(0.0);
        if (inertia > 0.0) product = product_at(n, inertia, p);
        products[n] = vec4(product, 0.0);
        force += vec4(product, dot(p, product));
        moment += cross(texelFetch(positions, int(n)).xyz - center, product);
    }
    ResidualSums sum = sum_by_lanes(force, moment);
    if (lane == 0u) product_sums[c] = sum;
}
