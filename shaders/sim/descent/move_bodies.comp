// Moves bodies as rigid ones. LAST: the velocity is the way over the step, and nodes that a collider has stopped go back
// with restitution times the speed that they would have had without it.
// CPU twin: gelatin::cpu::BlockDescent. Parity: tests/gpu/descent/block_descent_test.cpp.
#include "include/global_index.glsl"
#include "sim/descent/descent_step.glsl"
#include "layouts/chunk.glsl"
#include "layouts/descent.glsl"
#ifdef LAST
#include "sim/collision/colliders.glsl"
#endif
layout(local_size_x = 64) in;

uniform samplerBuffer positions;  // xyz [m], inverse mass [1/kg]; of out_positions
layout(std430) writeonly buffer OutPositions { vec4 out_positions[]; };  // an invocation has its own nodes
layout(std430) writeonly buffer Velocities { vec4 velocities[]; };
layout(std430) readonly buffer Chunks { Chunk chunks[]; };
layout(std430) readonly buffer Motions { RigidMotion motions[]; };
uniform uint element_count;
#ifdef LAST
layout(std430) readonly buffer ObjectTouches { uint object_touches[]; };
uniform float contact_distance;  // [m]
uniform float resting_speed;     // [m/s]
#endif

void main() {
    uint c = group_index();
    if (c >= element_count) return;
    Chunk chunk = chunks[c];
    RigidMotion motion = motions[chunk.object];
    mat3 turn = mat3(motion.turn_x.xyz, motion.turn_y.xyz, motion.turn_z.xyz);
    for (uint k = gl_LocalInvocationID.x; k < chunk.count; k += 64u) {
        uint n = chunk.first + k;
        vec4 position = texelFetch(positions, int(n));
        if (motion.center.w != 0.0) {
            position.xyz = motion.center.xyz + motion.shift.xyz + turn * (position.xyz - motion.center.xyz);
            out_positions[n] = position;
        }
#ifdef LAST
        vec4 before = texelFetch(start_velocities, int(n));
        vec3 start = texelFetch(start_positions, int(n)).xyz;
        vec3 velocity = (position.xyz - start) / time_step;
        if (object_touches[chunk.object] != 0u) {
            rebound(position.xyz, (target_of(n) - start) / time_step, contact_distance, resting_speed, velocity);
        }
        velocities[n] = vec4(position.w > 0.0 ? velocity : before.xyz, before.w);
#endif
    }
}
