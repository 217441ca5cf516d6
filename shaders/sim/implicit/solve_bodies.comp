// Bodies as rigid ones in the system of a step. Without OBJECTS: sums over a chunk's nodes, a work group each; with it: centre
// and inertia, one invocation an object.
// CPU twin: gelatin::cpu::RigidLevel::begin. Parity: tests/gpu/implicit/step_system_test.cpp.
#include "include/global_index.glsl"
#include "layouts/step_system.glsl"
layout(local_size_x = 64) in;

uniform samplerBuffer positions;  // xyz [m]
uniform usamplerBuffer chunks;    // of nodes
uniform uint element_count;

#ifdef OBJECTS
uniform usamplerBuffer chunk_starts;  // of each object, and the end
uniform samplerBuffer enough;         // energy that may be missing, of each object [J]
uniform samplerBuffer weights;        // of each object [N]
layout(std430) readonly buffer BodySums { StepBodySums sums[]; };
layout(std430) writeonly buffer Bodies { StepBody bodies[]; };
layout(std430) writeonly buffer Inverses { BodyInverse inverses[]; };

void main() {
    uint object = global_index();
    if (object >= element_count) return;
    vec4 arm = vec4(0.0), square = vec4(0.0), beside = vec4(0.0);
    uint first = texelFetch(chunk_starts, int(object)).x, end = texelFetch(chunk_starts, int(object) + 1).x;
    for (uint c = first; c < end; ++c) {
        arm += sums[c].arm;
        square += sums[c].square;
        beside += sums[c].beside;
    }
    float missing = texelFetch(enough, int(object)).x;
    float weight = texelFetch(weights, int(object)).x;
    if (!(arm.w > 0.0) || square.w > 0.0) {
        vec4 no = vec4(0.0);
        bodies[object] = StepBody(no, vec4(vec3(0.0), missing), vec4(vec3(0.0), weight), no, no);
        inverses[object] = BodyInverse(no, no, no, no, no, no, no, no, no);
        return;
    }
    vec3 middle = arm.xyz / arm.w;
    vec3 s = square.xyz - arm.w * middle * middle, b = beside.xyz - arm.w * middle.yzx * middle.zxy;
    vec3 diagonal = s.yzx + s.zxy;
    mat3 i = inverse(mat3(diagonal.x, -b.z, -b.y, -b.z, diagonal.y, -b.x, -b.y, -b.x, diagonal.z));
    vec3 origin = texelFetch(positions, int(texelFetch(chunks, int(first)).w)).xyz;
    bodies[object] = StepBody(vec4(origin + middle, 1.0 / arm.w), vec4(i[0].x, i[1].y, i[2].z, missing),
                              vec4(i[1].z, i[2].x, i[0].y, weight), vec4(diagonal, arm.w), vec4(-b, 0.0));
    mat3 a = mat3(1.0 / arm.w);
    inverses[object] = BodyInverse(vec4(a[0], 0.0), vec4(a[1], 0.0), vec4(a[2], 0.0), vec4(0.0), vec4(0.0), vec4(0.0),
                                   vec4(i[0], 0.0), vec4(i[1], 0.0), vec4(i[2], 0.0));
}
#else
uniform samplerBuffer loads;  // w: m / h^2 [N/m], 0 where a node is held
layout(std430) writeonly buffer BodySums { StepBodySums sums[]; };
shared StepBodySums parts[64];

void main() {
    uint c = group_index();
    if (c >= element_count) return;
    uvec4 chunk = texelFetch(chunks, int(c));  // object, first, count, origin
    vec3 origin = texelFetch(positions, int(chunk.w)).xyz;
    uint lane = gl_LocalInvocationID.x;
    StepBodySums own = StepBodySums(vec4(0.0), vec4(0.0), vec4(0.0));
    for (uint n = chunk.y + lane; n < chunk.y + chunk.z; n += 64u) {
        float inertia = texelFetch(loads, int(n)).w;
        vec3 x = texelFetch(positions, int(n)).xyz - origin;
        own.arm += inertia * vec4(x, 1.0);
        own.square += vec4(inertia * x * x, inertia > 0.0 ? 0.0 : 1.0);
        own.beside.xyz += inertia * x.yzx * x.zxy;
    }
    parts[lane] = own;
    for (uint half_ = 32u; half_ > 0u; half_ /= 2u) {
        barrier();
        if (lane < half_) {
            parts[lane].arm += parts[lane + half_].arm;
            parts[lane].square += parts[lane + half_].square;
            parts[lane].beside += parts[lane + half_].beside;
        }
    }
    if (lane == 0u) sums[c] = parts[0];
}
#endif
