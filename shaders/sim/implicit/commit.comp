// A part that is made: velocities get what its end gives or takes, accelerations are those that velocities have changed by, whatever
// did it but impacts, and where it ends is where the next begins. A work group a chunk.
// CPU twins: gelatin::cpu::TimeScheme::end, ImplicitStep::stand_still. Parity: tests/gpu/implicit/part_end_test.cpp.
#include "layouts/step_end.glsl"
#include "layouts/step_state.glsl"
#include "sim/implicit/solve_system.glsl"
#include "sim/implicit/time_scheme.glsl"
layout(local_size_x = 64) in;

uniform samplerBuffer end_positions;
uniform samplerBuffer end_velocities;
uniform uint collider_count;
uniform uint body_node_count;
layout(std430) readonly buffer Clock { StepClock clock[]; };
layout(std430) readonly buffer Paces { BodyPace paces[]; };
layout(std430) readonly buffer BodyChanges { BodyChange changes[]; };
layout(std430) writeonly buffer Positions { vec4 start_positions[]; };
layout(std430) buffer Velocities { vec4 start_velocities[]; };
layout(std430) buffer Accelerations { vec4 accelerations[]; };  // a_0 [m/s^2]
layout(std430) readonly buffer PlaneNotes { PlaneMemory notes[]; };
layout(std430) writeonly buffer PlaneMemories { PlaneMemory memories[]; };

void main() {
    uint c = group_index();
    if (c >= chunk_count) return;
    uvec4 chunk = texelFetch(chunks, int(c));
    BodyChange change = changes[chunk.x];
    if (change.action == 0u) return;
    Scheme scheme = scheme_of(clock[0].last_step, paces[chunk.x].past);
    for (uint n = chunk.y + gl_LocalInvocationID.x; n < chunk.y + chunk.z; n += 64u) {
        vec4 x = texelFetch(end_positions, int(n)), v = texelFetch(end_velocities, int(n)), before = start_velocities[n];
        if (change.action == 2u) v = x.w > 0.0 ? vec4(vec3(0.0), v.w) : v;
        else if (x.w > 0.0)
            v.xyz += change.velocity.xyz - change.center.w * v.xyz + cross(change.spin.xyz, x.xyz - change.center.xyz);
        accelerations[n] = vec4(rate_by(scheme, accelerations[n].xyz, v.xyz - before.xyz), 0.0);
        bool stays = change.action == 2u;  // x may not be finite
        if (x.w > 0.0 && !stays) v.xyz += change.bounce.xyz + cross(change.turn.xyz, x.xyz - change.center.xyz);
        start_velocities[n] = v;
        if (stays) continue;
        start_positions[n] = x;
        for (uint k = 0u; k < collider_count && n < body_node_count; ++k)
            memories[k * body_node_count + n] = notes[k * body_node_count + n];
    }
}
