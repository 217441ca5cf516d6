// Where block descent starts: as the last step went on, with as much of gravity as was felt in it, from none, where a
// body rests, to all, where it falls (Chen et al. 2024, 3.7). Without a last step as in free fall.
// CPU twin: gelatin::cpu::BlockDescent. Parity: tests/gpu/block_descent_test.cpp.
#include "include/global_index.glsl"
#include "include/descent_step.glsl"
layout(local_size_x = 64) in;

layout(std430, binding = 0) writeonly buffer Positions { vec4 positions[]; };
layout(std430, binding = 1) writeonly buffer NearFlat { uint near_flat[]; };
layout(std430, binding = 2) writeonly buffer Touches { uint object_touches[]; };
layout(std430, binding = 3) readonly buffer EarlierVelocities { vec4 earlier_velocities[]; };
uniform uint node_count;
uniform uint object_count;  // never more
uniform uint has_earlier;

void main() {
    uint n = global_index();
    if (n >= node_count) return;
    vec4 start = texelFetch(start_positions, int(n));
    vec3 velocity = texelFetch(start_velocities, int(n)).xyz;
    float squared = dot(gravity, gravity), felt = 1.0;
    if (has_earlier != 0u && squared > 0.0) {
        felt = clamp(dot(velocity - earlier_velocities[n].xyz, gravity) / (time_step * squared), 0.0, 1.0);
    }
    vec3 guess = start.xyz + time_step * (velocity + time_step * felt * gravity);
    positions[n] = vec4(start.w > 0.0 ? guess : start.xyz, start.w);
    near_flat[n] = 0u;
    if (n < object_count) object_touches[n] = 0u;
}
