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
    vec3 translation = vec3(0.0), rotation = vec3(0.0);
    for (uint c = 0u; c < size; ++c) {
        float load = loads[6u * body.first + c];
        uint e = first + c * size;
        translation += load * vec3(inverses[e], inverses[e + 1u], inverses[e + 2u]);
        rotation += load * vec3(inverses[e + 3u], inverses[e + 4u], inverses[e + 5u]);
    }
    mat3 orientation = mat3(clusters[k].orientation_x.xyz, clusters[k].orientation_y.xyz, clusters[k].orientation_z.xyz);
    clusters[k].translation = vec4(orientation * translation, 0.0);
    clusters[k].rotation = vec4(orientation * rotation, 0.0);
}
