// How each cluster is turned, and where its middle is; one work group a cluster.
// CPU twin: gelatin::cpu::CoarseCorrection::begin. Parity: tests/gpu/descent/block_descent_test.cpp.
#include "include/global_index.glsl"
#include "sim/descent/nearest_rotation.glsl"
#include "layouts/cluster.glsl"
layout(local_size_x = 64) in;

uniform samplerBuffer positions;        // xyz [m], inverse mass [1/kg]
uniform usamplerBuffer core_nodes;      // of each cluster
uniform samplerBuffer rest_positions;   // xyz [m]
layout(std430) readonly buffer Rests { ClusterRest rests[]; };
layout(std430) writeonly buffer Clusters { Cluster clusters[]; };
uniform uint cluster_count;

struct Sums {
    vec4 moved;   // m x; w: m
    mat3 moment;  // m x X^T
};
shared Sums parts[64];

void main() {
    uint k = group_index();
    if (k >= cluster_count) return;
    ClusterRest rest = rests[k];
    vec3 origin = texelFetch(positions, int(texelFetch(core_nodes, int(rest.core_first)).x)).xyz;
    uint lane = gl_LocalInvocationID.x;
    Sums sums = Sums(vec4(0.0), mat3(0.0));
    for (uint c = rest.core_first + lane; c < rest.core_end; c += 64u) {
        int n = int(texelFetch(core_nodes, int(c)).x);
        vec4 position = texelFetch(positions, n);
        float mass = 1.0 / position.w;
        vec3 x = mass * (position.xyz - origin);
        sums.moved += vec4(x, mass);
        sums.moment += outerProduct(x, texelFetch(rest_positions, n).xyz - rest.middle.xyz);
    }
    parts[lane] = sums;
    barrier();
    if (lane != 0u) return;
    for (uint l = 1u; l < 64u; ++l) {
        sums.moved += parts[l].moved;
        sums.moment += parts[l].moment;
    }
    mat3 turn = nearest_rotation(sums.moment);
    clusters[k].middle = vec4(origin + sums.moved.xyz / sums.moved.w, 0.0);
    clusters[k].turn_x = vec4(turn[0], 0.0);
    clusters[k].turn_y = vec4(turn[1], 0.0);
    clusters[k].turn_z = vec4(turn[2], 0.0);
}
