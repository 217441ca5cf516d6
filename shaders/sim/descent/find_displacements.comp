// Where each node goes with its clusters; one invocation a node.
// CPU twin: gelatin::cpu::CoarseCorrection::find_ways. Parity: tests/gpu/descent/block_descent_test.cpp.
#include "include/global_index.glsl"
#include "layouts/cluster.glsl"
layout(local_size_x = 64) in;

uniform samplerBuffer positions;     // xyz [m], inverse mass [1/kg]
uniform usamplerBuffer node_starts;  // in node_parts
uniform usamplerBuffer node_parts;   // cluster, weight
layout(std430) readonly buffer Clusters { Cluster clusters[]; };
layout(std430) writeonly buffer Ways { vec4 ways[]; };    // [m]
layout(std430) writeonly buffer Ahead { vec4 ahead[]; };  // positions at the ways' ends
uniform uint node_count;

void main() {
    uint n = global_index();
    if (n >= node_count) return;
    vec4 position = texelFetch(positions, int(n));
    uint end = texelFetch(node_starts, int(n) + 1).x;
    vec3 way = vec3(0.0);
    for (uint p = texelFetch(node_starts, int(n)).x; p < end; ++p) {
        uvec2 part = texelFetch(node_parts, int(p)).xy;
        Cluster cluster = clusters[part.x];
        way += uintBitsToFloat(part.y) * (cluster.shift.xyz + cross(cluster.spin.xyz, position.xyz - cluster.middle.xyz));
    }
    ways[n] = vec4(way, 0.0);
    ahead[n] = vec4(position.xyz + way, position.w);
}
