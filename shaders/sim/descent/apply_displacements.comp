// Bodies go as far along their nodes' displacements as the objective falls. With SUMS: the work of the forces along the
// displacements of a chunk's nodes, one work group a chunk. With OBJECTS: the part of the displacements at which that is
// zero, by the secant through its values
// here and at their ends, one invocation an object. With neither: all nodes of a chunk go.
// CPU twin: gelatin::cpu::CoarseStep. Parity: tests/gpu/descent/block_descent_test.cpp.
#include "include/global_index.glsl"
#include "layouts/chunk.glsl"
#include "layouts/cluster.glsl"
layout(local_size_x = 64) in;

layout(std430) readonly buffer Chunks { Chunk chunks[]; };
layout(std430) buffer Sums { vec4 sums[]; };        // of chunks: here, ahead [J], square of the longest [m^2]
layout(std430) readonly buffer Displacements { vec4 displacements[]; };  // [m]
#ifndef SUMS
layout(std430) buffer Factors { float factors[]; };    // by object
#endif
uniform uint element_count;

#if defined(SUMS)
layout(std430) readonly buffer ForcesHere { vec4 forces_here[]; };  // [N]
layout(std430) readonly buffer ForcesAhead { vec4 forces_ahead[]; };
shared vec3 parts[64];

void main() {
    uint c = group_index();
    if (c >= element_count) return;
    Chunk chunk = chunks[c];
    uint lane = gl_LocalInvocationID.x;
    vec3 sum = vec3(0.0);
    for (uint k = lane; k < chunk.count; k += 64u) {
        uint n = chunk.first + k;
        vec3 displacement = displacements[n].xyz;
        sum.xy += vec2(dot(forces_here[n].xyz, displacement), dot(forces_ahead[n].xyz, displacement));
        sum.z = max(sum.z, dot(displacement, displacement));
    }
    parts[lane] = sum;
    barrier();
    if (lane != 0u) return;
    for (uint l = 1u; l < 64u; ++l) sum = vec3(sum.xy + parts[l].xy, max(sum.z, parts[l].z));
    sums[c] = vec4(sum, 0.0);
}
#elif defined(OBJECTS)
uniform usamplerBuffer chunk_starts;  // of each object, and the end
layout(std430) readonly buffer Bodies { CoarseBody bodies[]; };
const float kFarthest = 2.0;  // displacements are made longer by no more

bool is_finite(float x) { return !(isinf(x) || isnan(x)); }

void main() {
    uint object = global_index();
    if (object >= element_count) return;
    uint end = texelFetch(chunk_starts, int(object) + 1).x;
    vec3 sum = vec3(0.0);
    for (uint c = texelFetch(chunk_starts, int(object)).x; c < end; ++c)
        sum = vec3(sum.xy + sums[c].xy, max(sum.z, sums[c].z));
    float here = sum.x, ahead = sum.y;
    bool goes = here > 0.0 && is_finite(here) && is_finite(ahead);
    float factor = here / max(here - ahead, here / kFarthest);
    factors[object] = goes ? min(factor, bodies[object].body_length / sqrt(sum.z)) : 0.0;
}
#else
layout(std430) buffer Positions { vec4 positions[]; };  // an invocation reads and writes its own nodes

void main() {
    uint c = group_index();
    if (c >= element_count) return;
    Chunk chunk = chunks[c];
    float factor = factors[chunk.object];
    if (factor == 0.0) return;
    for (uint k = gl_LocalInvocationID.x; k < chunk.count; k += 64u)
        positions[chunk.first + k].xyz += factor * displacements[chunk.first + k].xyz;
}
#endif
