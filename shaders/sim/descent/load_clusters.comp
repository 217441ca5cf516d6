// What acts on each cluster, as it was at rest; one work group a cluster.
// CPU twin: gelatin::cpu::CoarseCorrection::gather. Parity: tests/gpu/descent/block_descent_test.cpp.
#include "include/global_index.glsl"
#include "layouts/cluster.glsl"
layout(local_size_x = 64) in;

uniform samplerBuffer positions;        // xyz [m]
uniform usamplerBuffer cluster_starts;  // in cluster_parts
uniform usamplerBuffer cluster_parts;   // node, weight
layout(std430) readonly buffer Forces { vec4 forces[]; };  // on nodes [N]
layout(std430) readonly buffer Clusters { Cluster clusters[]; };
layout(std430) writeonly buffer Loads { float loads[]; };  // six a cluster: force [N], moment [N m]
uniform uint cluster_count;

shared vec3 part_forces[64], part_moments[64];

void main() {
    uint k = group_index();
    if (k >= cluster_count) return;
    Cluster cluster = clusters[k];
    uint lane = gl_LocalInvocationID.x;
    uint end = texelFetch(cluster_starts, int(k) + 1).x;
    vec3 force = vec3(0.0), moment = vec3(0.0);
    for (uint p = texelFetch(cluster_starts, int(k)).x + lane; p < end; p += 64u) {
        uvec2 part = texelFetch(cluster_parts, int(p)).xy;
        vec3 f = uintBitsToFloat(part.y) * forces[part.x].xyz;
        force += f;
        moment += cross(texelFetch(positions, int(part.x)).xyz - cluster.middle.xyz, f);
    }
    part_forces[lane] = force;
    part_moments[lane] = moment;
    barrier();
    if (lane != 0u) return;
    for (uint l = 1u; l < 64u; ++l) {
        force += part_forces[l];
        moment += part_moments[l];
    }
    mat3 turn = mat3(cluster.turn_x.xyz, cluster.turn_y.xyz, cluster.turn_z.xyz);
    force = force * turn;
    moment = moment * turn;
    for (uint c = 0u; c < 3u; ++c) {
        loads[6u * k + c] = force[c];
        loads[6u * k + 3u + c] = moment[c];
    }
}
