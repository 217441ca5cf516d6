// Where block descent starts: the nodes where they would be without springs, held ones where their handle is; nothing
// marked.
// CPU twin: gelatin::cpu::BlockDescent. Parity: tests/gpu/block_descent_test.cpp.
#include "include/global_index.glsl"
#include "include/descent_step.glsl"
layout(local_size_x = 64) in;

layout(std430, binding = 0) writeonly buffer Positions { vec4 positions[]; };
layout(std430, binding = 1) writeonly buffer NearFlat { uint near_flat[]; };
layout(std430, binding = 2) writeonly buffer Touches { uint object_touches[]; };
uniform uint node_count;
uniform uint object_count;  // never more

void main() {
    uint n = global_index();
    if (n >= node_count) return;
    vec4 start = texelFetch(start_positions, int(n));
    vec3 held = start.xyz + time_step * texelFetch(start_velocities, int(n)).xyz;
    positions[n] = vec4(start.w > 0.0 ? target_of(n) : held, start.w);
    near_flat[n] = 0u;
    if (n < object_count) object_touches[n] = 0u;
}
