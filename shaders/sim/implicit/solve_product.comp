// A p for the direction p of an iteration, and p . A p by chunk.
// CPU twin: gelatin::cpu::IslandSolve::multiply_direction. Parity: tests/gpu/implicit/step_system_test.cpp.
#define PRODUCTS
#include "sim/implicit/half_edges.glsl"
#include "sim/implicit/solve_system.glsl"
layout(local_size_x = 64) in;

layout(std430) readonly buffer States { SolveState states[]; };
layout(std430) writeonly buffer Products { vec4 products[]; };      // [N]
layout(std430) writeonly buffer Curvatures { float curvatures[]; };  // by chunk [J]
shared float parts[64];

void main() {
    uint c = group_index();
    if (c >= chunk_count) return;
    uvec4 chunk = texelFetch(chunks, int(c));
    if (states[state_before(chunk.x)].is_done != 0u) return;
    uint lane = gl_LocalInvocationID.x;
    float sum = 0.0;
    for (uint n = chunk.y + lane; n < chunk.y + chunk.z; n += 64u) {
        float inertia = texelFetch(loads, int(n)).w;
        vec3 p = texelFetch(displacements, int(n)).xyz;
        vec3 product = inertia > 0.0 ? stiffness_times(n, p) + inertia * p : vec3(0.0);
        products[n] = vec4(product, 0.0);
        sum += dot(p, product);
    }
    parts[lane] = sum;
    for (uint half_ = 32u; half_ > 0u; half_ /= 2u) {
        barrier();
        if (lane < half_) parts[lane] += parts[lane + half_];
    }
    if (lane == 0u) curvatures[c] = parts[0];
}
