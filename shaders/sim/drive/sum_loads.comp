// The force of all loads on each node that has any. One invocation a node, a fixed order of summation.
// CPU twin: gelatin::cpu::sum_loads. Parity: tests/gpu/drive/sum_loads_test.cpp.
#include "include/global_index.glsl"
#include "layouts/load.glsl"
layout(local_size_x = 64) in;

uniform samplerBuffer positions;                            // xyz [m]
layout(std430) writeonly buffer LoadForces { vec4 load_forces[]; };  // [N]
layout(std430) readonly buffer LoadedNodes { LoadedNode loaded_nodes[]; };
layout(std430) readonly buffer NodeLoads { NodeLoad node_loads[]; };
layout(std430) readonly buffer Factors { float factors[]; };  // of each load
uniform uint loaded_count;

vec3 position_of(uint node) { return texelFetch(positions, int(node)).xyz; }

void main() {
    uint k = global_index();
    if (k >= loaded_count) return;
    LoadedNode loaded = loaded_nodes[k];
    vec3 position = position_of(loaded.node);
    vec3 sum = vec3(0.0);
    for (uint e = loaded.first; e < loaded.end; ++e) {
        NodeLoad load = node_loads[e];
        vec3 twice_area = cross(position_of(load.b) - position, position_of(load.c) - position);
        sum += factors[load.load] * (load.force.xyz - load.force.w * twice_area);
    }
    load_forces[loaded.node] = vec4(sum, 0.0);
}
