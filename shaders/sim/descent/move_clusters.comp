// The motion of each cluster under the loads on all of its object's; one invocation a cluster.
// CPU twin: gelatin::cpu::CoarseCorrection::solve. Parity: tests/gpu/descent/block_descent_test.cpp.
#include "include/global_index.glsl"
#include "layouts/cluster.glsl"
layout(local_size_x = 64) in;

layout(std430) readonly buffer Rests { ClusterRest rests[]; };
layout(std430) buffer Clusters { Cluster clusters[]; };
layout(std430) readonly buffer Loads { float loads[]; };
layout(std430) readonly buffer Inverses { float inverses[]; };  // symmetric, object by object
layout(std430) readonly buffer Bodies { CoarseBody bodies[]; };  // by object
uniform uint cluster_count;

void main() {
    uint k = global_index();
    if (k >= cluster_count) return;
    CoarseBody body = bodies[rests[k].object];
    uint size = 6u * body.count, first = body.matrix + rests[k].row;
    vec3 shift = vec3(0.0), spin = vec3(0.0);
    for (uint c = 0u; c < size; ++c) {
        float load = loads[6u * body.first + c];
        uint e = first + c * size;
        shift += load * vec3(inverses[e], inverses[e + 1u], inverses[e + 2u]);
        spin += load * vec3(inverses[e + 3u], inverses[e + 4u], inverses[e + 5u]);
    }
    mat3 turn = mat3(clusters[k].turn_x.xyz, clusters[k].turn_y.xyz, clusters[k].turn_z.xyz);
    clusters[k].shift = vec4(turn * shift, 0.0);
    clusters[k].spin = vec4(turn * spin, 0.0);
}
