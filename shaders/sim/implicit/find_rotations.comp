// How bodies that are convex at the start have rotated since, where their paths end; and nothing has lost distances yet. What the guard
// asks for goes on with both. A work group a body.
// CPU twin: gelatin::cpu::KeptDistances. Parity: tests/gpu/implicit/find_pairs_test.cpp.
const uint kLanes = 256u;
#include "include/global_index.glsl"
#include "sim/implicit/group_sums.glsl"
#include "sim/recovery/nearest_rotation.glsl"
layout(local_size_x = 256) in;

uniform samplerBuffer path_ends;       // xyz [m]
uniform samplerBuffer rest_positions;  // at the start, xyz [m]
uniform usamplerBuffer object_nodes;   // by object: first, end
uniform usamplerBuffer convex_bodies;  // by object: 1: it is
uniform uint body_count;
layout(std430) writeonly buffer Rotations { vec4 rotations[]; };   // by object, three columns
layout(std430) writeonly buffer LostBoxes { uvec4 lost_boxes[]; };  // by object: ordered bits of least and greatest coordinates

void main() {
    uint o = group_index(), lane = gl_LocalInvocationID.x;
    if (o >= body_count || texelFetch(convex_bodies, int(o)).x == 0u) return;
    uvec2 nodes = texelFetch(object_nodes, int(o)).xy;
    vec3 first = texelFetch(rest_positions, int(nodes.x)).xyz, first_end = texelFetch(path_ends, int(nodes.x)).xyz;
    vec4 x = vec4(0.0), y = x, z = x, ends = x;  // columns of the moment; w: sums at the start
    for (uint n = nodes.x + lane; n < nodes.y; n += kLanes) {
        vec3 rest = texelFetch(rest_positions, int(n)).xyz - first, end = texelFetch(path_ends, int(n)).xyz - first_end;
        x += rest.x * vec4(end, 1.0);
        y += rest.y * vec4(end, 1.0);
        z += rest.z * vec4(end, 1.0);
        ends += vec4(end, 1.0);
    }
    x = sum_over_group(x);
    y = sum_over_group(y);
    z = sum_over_group(z);
    ends = sum_over_group(ends);
    if (lane != 0u) return;
    vec3 end = ends.xyz / ends.w;
    mat3 rotation = nearest_rotation(mat3(x.xyz - x.w * end, y.xyz - y.w * end, z.xyz - z.w * end));
    for (uint k = 0u; k < 3u; ++k) rotations[3u * o + k] = vec4(rotation[k], 0.0);
    lost_boxes[2u * o] = uvec4(0xFFFFFFFFu);
    lost_boxes[2u * o + 1u] = uvec4(0u);
}
