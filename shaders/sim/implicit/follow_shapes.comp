// Bodies that were given their shapes back go there only if nothing is in the way: where nodes go is a part of its own for the guard of
// pairs, if any goes anywhere. With END, after the guard: they are there, if it has let all of them. An invocation a node.
// CPU twin: gelatin::cpu::ImplicitStep::follow. Parity: tests/gpu/implicit/body_contacts_test.cpp.
#include "include/global_index.glsl"
#include "layouts/pair_guard.glsl"
#include "layouts/step_state.glsl"
layout(local_size_x = 64) in;

uniform samplerBuffer end_positions;
uniform uint node_count;
layout(std430) buffer Clock { StepClock clock[]; };
#ifdef END
uniform samplerBuffer end_velocities;
layout(std430) readonly buffer Guard { GuardState guard[]; };
layout(std430) writeonly buffer Positions { vec4 start_positions[]; };
layout(std430) writeonly buffer Velocities { vec4 start_velocities[]; };

void main() {
    uint n = global_index();
    if (n >= node_count || clock[0].goes_on == 0u || guard[0].is_changed != 0u) return;
    start_positions[n] = texelFetch(end_positions, int(n));
    start_velocities[n] = texelFetch(end_velocities, int(n));
}
#else
uniform samplerBuffer positions;
layout(std430) writeonly buffer Predicted { vec4 predicted[]; };  // displacements [m]; w: 1 of free nodes [m/N]

void main() {
    uint n = global_index();
    if (n >= node_count) return;
    vec4 x = texelFetch(positions, int(n));
    vec3 d = texelFetch(end_positions, int(n)).xyz - x.xyz;
    predicted[n] = vec4(d, x.w > 0.0 ? 1.0 : 0.0);
    if (d == vec3(0.0)) return;
    clock[0].goes_on = 1u;  // whoever writes it writes the same
    clock[0].step = 0.0;    // the shortest part, which is not halved
}
#endif
