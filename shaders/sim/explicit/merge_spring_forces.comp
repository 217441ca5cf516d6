// The paper's way, second kernel (3.3): each node adds up the forces of its springs.
// CPU twin: gelatin::cpu::merge_spring_forces. Parity: tests/gpu/explicit/divide_and_merge_test.cpp.
#include "include/global_index.glsl"
layout(local_size_x = 64) in;

layout(std430) readonly buffer SpringForces { vec4 spring_forces[]; };  // on the first endpoint [N]
layout(std430) readonly buffer Starts { uint starts[]; };               // SpringIncidence, src/model/model.h
layout(std430) readonly buffer Entries { uint entries[]; };
layout(std430) writeonly buffer NodeForces { vec4 node_forces[]; };     // [N]
uniform uint node_count;

void main() {
    uint n = global_index();
    if (n >= node_count) return;
    vec3 force = vec3(0.0);
    uint end = starts[n + 1u];
    for (uint e = starts[n]; e < end; ++e) {
        uint entry = entries[e];
        vec3 on_first = spring_forces[entry / 2u].xyz;
        force += entry % 2u == 0u ? on_first : -on_first;
    }
    node_forces[n] = vec4(force, 0.0);
}
