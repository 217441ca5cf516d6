// Notes the first step after which nodes are not finite, or have more energy each than all bodies together can have.
// Steps come one after the other: where an earlier one is noted, its note stays. Atomics are met by bad nodes alone, and
// least, number and greatest do not depend on their order.
// CPU twin: gelatin::cpu::watch_nodes. Parity: tests/gpu/measure/watch_nodes_test.cpp.
#include "include/global_index.glsl"
#include "layouts/alarm.glsl"
layout(local_size_x = 64) in;

uniform samplerBuffer positions;   // xyz [m], inverse mass [1/kg]
uniform samplerBuffer velocities;  // xyz [m/s]
layout(std430) buffer Alarms { Alarm alarm; };
uniform uint node_count;
uniform uint step_number;
uniform float most_energy;  // kinetic, of one node [J]; may be infinite

const uint kNotANumber = 0x7FC00000u;

// By the bits: drivers may take isnan and isinf for false.
bool is_finite(vec3 v) {
    return all(notEqual(floatBitsToUint(v) & 0x7F800000u, uvec3(0x7F800000u)));
}

void main() {
    uint n = global_index();
    if (n >= node_count) return;
    vec4 position = texelFetch(positions, int(n));
    vec3 velocity = texelFetch(velocities, int(n)).xyz;
    bool finite = is_finite(position.xyz) && is_finite(velocity);
    bool pinned = position.w == 0.0;
    if (finite && (pinned || 0.5 * dot(velocity, velocity) <= most_energy * position.w)) return;
    if (atomicMin(alarm.step, step_number) < step_number) return;
    atomicMin(alarm.node, n);
    atomicAdd(alarm.count, 1u);
    atomicMax(alarm.speed, finite ? floatBitsToUint(length(velocity)) : kNotANumber);
}
