// Where nodes would go in a part without forces of elements and contacts, by how much contacts may move them, and velocities that
// take held nodes to their goals; by chunk what is asked about bodies. A work group a chunk.
// CPU twin: gelatin::cpu::ImplicitStep::predict. Parity: tests/gpu/implicit/part_start_test.cpp.
const uint kLanes = 64u;
#include "layouts/contact_tuning.glsl"
#include "sim/implicit/acceleration.glsl"
#include "sim/implicit/group_sums.glsl"
#include "sim/implicit/node_chunks.glsl"
layout(local_size_x = 64) in;

uniform samplerBuffer positions;       // xyz [m]; w: inverse mass, 0: held
uniform samplerBuffer goals;           // of held nodes [m]
uniform samplerBuffer masses;          // [kg]
uniform samplerBuffer node_stiffness;  // [N/m]
layout(std430) buffer Velocities { vec4 velocities[]; };            // xyz [m/s]
layout(std430) writeonly buffer Predicted { vec4 predicted[]; };    // displacements [m]; w: 1 / h of contacts [m/N]
layout(std430) writeonly buffer PartSums { StartSums part_sums[]; };  // by chunk

void main() {
    uint c = group_index(), lane = gl_LocalInvocationID.x;
    if (c >= chunk_count) return;
    uvec4 chunk = texelFetch(chunks, int(c));
    float step = clock[0].step, left = clock[0].left, least = max(step, kFrame);
    StartSums own = StartSums(vec4(0.0), vec4(0.0), 0.0, 0.0, 0.0, 0.0);
    for (uint n = chunk.y + lane; n < chunk.y + chunk.z; n += kLanes) {
        vec4 x = texelFetch(positions, int(n)), v = velocities[n];
        bool is_held = x.w == 0.0;
        if (is_held) {
            v.xyz = (texelFetch(goals, int(n)).xyz - x.xyz) / left;
            velocities[n] = v;
        }
        vec3 d = step * v.xyz;
        float compliance = 0.0, mass = texelFetch(masses, int(n)).x;
        if (!is_held) {
            d += step * step * acceleration(n, x.w);
            compliance = 1.0 / (1.0 / (x.w * least * least) + texelFetch(node_stiffness, int(n)).x / 3.0);
            mass = 1.0 / x.w;
        }
        predicted[n] = vec4(d, compliance);
        vec4 momentum = mass * vec4(v.xyz, 1.0);
        own.momentum += momentum;
        if (is_held) own.carried += momentum;
        if (is_held) own.held_count += 1.0;
    }
    StartSums sums = StartSums(sum_over_group(own.momentum), sum_over_group(own.carried), sum_over_group(own.held_count),
                               0.0, 0.0, 0.0);
    if (lane == 0u) part_sums[c] = sums;
}
