// The paths of nodes where a part begins, and by object their mean, and how far one goes beside it in reaches. The guard may have given
// paths other ends: then they stay. A work group an object.
// CPU twins: gelatin::cpu::ImplicitStep::detect, gelatin::cpu::FindPairs::begin. Parity: tests/gpu/implicit/find_pairs_test.cpp.
const uint kLanes = 256u;
#include "include/global_index.glsl"
#include "sim/implicit/clock.glsl"
#include "sim/implicit/group_sums.glsl"
#include "sim/implicit/part_choices.glsl"
layout(local_size_x = 256) in;

uniform samplerBuffer positions;      // xyz [m]; w: inverse mass, 0: held
uniform samplerBuffer predicted;      // displacements [m]
uniform samplerBuffer velocities;     // xyz [m/s]
uniform usamplerBuffer paces;         // BodyPace, five texels each
uniform samplerBuffer thicknesses;    // by object [m]
uniform usamplerBuffer object_nodes;  // by object: first, end
uniform uint object_count;
uniform uint body_count;
uniform uint finds_own;  // 1: bodies meet themselves
uniform uint follows;    // 1: nodes go as predicted
layout(std430) buffer PathEnds { vec4 path_ends[]; };
layout(std430) writeonly buffer Motions { vec4 motions[]; };
layout(std430) writeonly buffer Speeds { float speeds[]; };  // by object [reaches]

void main() {
    uint o = group_index(), lane = gl_LocalInvocationID.x;
    if (o >= object_count) return;
    uvec2 nodes = texelFetch(object_nodes, int(o)).xy;
    // What is calm is carried by what it touches.
    bool is_new = clock[0].guards == 0u, is_carried = follows == 0u && texelFetch(paces, 5 * int(o)).x != kMoving;
    vec3 sum = vec3(0.0);
    for (uint n = nodes.x + lane; n < nodes.y; n += kLanes) {
        vec4 x = texelFetch(positions, int(n));
        if (is_new) {
            vec3 d = texelFetch(predicted, int(n)).xyz;
            if (is_carried) d = clock[0].step * texelFetch(velocities, int(n)).xyz;
            path_ends[n] = vec4(x.xyz + d, x.w);
        }
        sum += path_ends[n].xyz - x.xyz;
    }
    vec3 motion = sum_over_group(vec4(sum, 0.0)).xyz / float(max(nodes.y - nodes.x, 1u));
    float farthest = 0.0;
    for (uint n = nodes.x + lane; n < nodes.y; n += kLanes)
        farthest = max(farthest, distance(path_ends[n].xyz - texelFetch(positions, int(n)).xyz, motion));
    farthest = max_over_group(farthest);
    if (lane != 0u) return;
    motions[o] = vec4(motion, 0.0);
    speeds[o] = finds_own != 0u && o < body_count ? farthest / (2.0 * texelFetch(thicknesses, int(o)).x) : 0.0;
}
