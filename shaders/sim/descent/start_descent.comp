// Where block descent starts: as the last step went on, with as much of gravity as was felt in it, from none, where a
// body rests, to all, where it falls (Chen et al. 2024, 3.7). Without a last step as in free fall. Nodes that are inside a
// collider are put outside first, which is no motion and gives them no speed. Held nodes are where
// their handle takes them.
// CPU twin: gelatin::cpu::BlockDescent. Parity: tests/gpu/descent/block_descent_test.cpp.
#include "include/global_index.glsl"
#include "sim/collision/colliders.glsl"
#include "sim/drive/load_force.glsl"
#include "sim/drive/pull.glsl"
#include "layouts/descent.glsl"
layout(local_size_x = 64) in;

layout(std430) writeonly buffer Positions { vec4 positions[]; };
layout(std430) writeonly buffer NearFlat { uint near_flat[]; };
layout(std430) writeonly buffer ObjectTouches { uint object_touches[]; };
layout(std430) readonly buffer EarlierVelocities { vec4 earlier_velocities[]; };
layout(std430) writeonly buffer Tangled { uint is_tangled[]; };  // by object
layout(std430) writeonly buffer Starts { vec4 starts[]; };        // xyz [m], inverse mass [1/kg]
layout(std430) writeonly buffer Targets { vec4 targets[]; };      // y [m], m / h^2 [N/m], 0 where held
#if COLLIDER_KINDS != 0
layout(std430) writeonly buffer Touches { Touch touches[]; };  // of nodes
#endif

uniform samplerBuffer start_positions;   // as the last step has left them
uniform samplerBuffer start_velocities;  // xyz [m/s], damping time [s]
uniform float time_step;                                     // [s]
uniform vec3 gravity;                                        // [m/s^2]
uniform uint node_count;
uniform uint object_count;  // never more
uniform uint has_earlier;

void main() {
    uint n = global_index();
    if (n >= node_count) return;
    vec4 start = texelFetch(start_positions, int(n));
    vec3 velocity = texelFetch(start_velocities, int(n)).xyz, none = vec3(0.0);
    if (start.w > 0.0) resolve_colliders(0.0, start.xyz, none);
    starts[n] = start;
    float squared = dot(gravity, gravity), felt = 1.0;
    if (has_earlier != 0u && squared > 0.0) {
        felt = clamp(dot(velocity - earlier_velocities[n].xyz, gravity) / (time_step * squared), 0.0, 1.0);
    }
    vec3 guess = start.xyz + time_step * (velocity + time_step * felt * gravity);
    vec3 held = start.xyz + time_step * velocity;
    positions[n] = vec4(start.w > 0.0 ? guess : held, start.w);
    vec3 acceleration = gravity;
#ifdef LOADED
    acceleration += start.w * load_force(n);
#endif
    vec4 target = vec4(start.xyz + time_step * (velocity + time_step * acceleration),
                       start.w > 0.0 ? 1.0 / (start.w * time_step * time_step) : 0.0);
#ifdef PULLED
    if (start.w > 0.0) target = with_pull(n, target, start.xyz, time_step);
#endif
    targets[n] = target;
    near_flat[n] = 0u;
#if COLLIDER_KINDS != 0
    touches[n] = Touch(vec4(0.0), vec4(0.0));
#endif
    if (n < object_count) {
        object_touches[n] = 0u;
        is_tangled[n] = 0u;
    }
}
