// The affine map of each restless object's rest shape that comes nearest to where its nodes are. Without OBJECTS: sums
// over a chunk's nodes, one work group a chunk; with it: the map, one invocation an object.
// CPU twin: gelatin::cpu::AffineFit. Parity: tests/gpu/collision/find_self_collisions_test.cpp.
#include "sim/collision/dispatches.glsl"
#include "sim/collision/rounding.glsl"
#include "include/global_index.glsl"
#include "layouts/box.glsl"
#include "layouts/chunk.glsl"
#include "layouts/rest_shape.glsl"
layout(local_size_x = 64) in;

uniform samplerBuffer positions;     // xyz [m]
uniform samplerBuffer rest_offsets;  // xyz [m]
layout(std430) readonly buffer BoundingBoxes { BoundingBox bounding_boxes[]; };
layout(std430) readonly buffer Chunks { Chunk chunks[]; };
layout(std430) buffer Sums { FitSums fit_sums[]; };
layout(std430) readonly buffer RestShapes { RestShape rest_shapes[]; };
layout(std430) writeonly buffer Fits { AffineFit fits[]; };
uniform usamplerBuffer chunk_starts;  // of each object, and the end

FitSums add(FitSums a, FitSums b) {
    return FitSums(a.column_x + b.column_x, a.column_y + b.column_y, a.column_z + b.column_z);
}

const FitSums kNothing = FitSums(vec4(0.0), vec4(0.0), vec4(0.0));

#ifdef OBJECTS
layout(std430) readonly buffer RestlessObjects { uint restless_objects[]; };


void main() {
    uint k = global_index();
    if (k >= dispatches[kFits].count) return;
    uint object = restless_objects[k];
    uint first = texelFetch(chunk_starts, int(object)).x, end = texelFetch(chunk_starts, int(object) + 1).x;
    FitSums sums = kNothing;
    for (uint c = first; c < end; ++c) sums = add(sums, fit_sums[c]);

    RestShape rest = rest_shapes[object];
    BoundingBox box = bounding_boxes[object];
    mat3 moment = mat3(sums.column_x.xyz, sums.column_y.xyz, sums.column_z.xyz);
    mat3 map = moment * mat3(rest.inverse_moment_x.xyz, rest.inverse_moment_y.xyz, rest.inverse_moment_z.xyz);
    vec3 origin = texelFetch(positions, int(chunks[first].origin)).xyz;
    vec3 sum = vec3(sums.column_x.w, sums.column_y.w, sums.column_z.w);
    vec3 center = origin + sum / float(box.node_count);
    // The least singular value is at least |det| 2 / |map|^2 (Frobenius), by the means of the other two.
    float square = dot(map[0], map[0]) + dot(map[1], map[1]) + dot(map[2], map[2]);
    float half_stretch = square > 0.0 ? abs(determinant(map)) / square : 0.0;
    vec3 farthest = max(abs(box.min.xyz), abs(box.max.xyz));
    float rounding = 32.0 * kEpsilon * (farthest.x + farthest.y + farthest.z + rest.inverse_moment_x.w);
    vec3 extent = box.max.xyz - box.min.xyz;
    float sizes = extent.x + extent.y + extent.z + rest.inverse_moment_x.w;
    fits[object] = AffineFit(vec4(map[0], half_stretch), vec4(map[1], rounding),
                             vec4(map[2], half_stretch * rest.inverse_moment_y.w), vec4(center, sizes),
                             vec4(origin, 0.0));
}
#else
layout(std430) readonly buffer RestlessNodeChunks { uint restless_chunks[]; };

shared FitSums parts[64];

void main() {
    uint c = restless_chunks[gl_WorkGroupID.x];
    Chunk chunk = chunks[c];
    vec3 origin = texelFetch(positions, int(chunk.origin)).xyz;
    uint lane = gl_LocalInvocationID.x;
    FitSums sums = kNothing;
    for (uint k = lane; k < chunk.count; k += 64u) {
        int n = int(chunk.first + k);
        vec3 x = texelFetch(positions, n).xyz - origin;
        vec3 rest = texelFetch(rest_offsets, n).xyz;
        sums = add(sums, FitSums(vec4(x * rest.x, x.x), vec4(x * rest.y, x.y), vec4(x * rest.z, x.z)));
    }
    parts[lane] = sums;
    barrier();
    if (lane != 0u) return;
    for (uint l = 1u; l < 64u; ++l) sums = add(sums, parts[l]);
    fit_sums[c] = sums;
}
#endif
