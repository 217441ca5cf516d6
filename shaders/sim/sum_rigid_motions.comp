// The motion of each body as a rigid one that takes it to where the objective is least. Without OBJECTS: sums over a
// chunk's nodes, one work group a chunk; with it: the motion, one invocation an object.
// CPU twin: gelatin::cpu::nearest_rigid_motion. Parity: tests/gpu/block_descent_test.cpp.
#include "include/global_index.glsl"
#include "include/descent_step.glsl"
#include "include/node_terms.glsl"
#include "layouts/chunk.glsl"
#include "layouts/descent.glsl"
layout(local_size_x = 64) in;

layout(binding = 0) uniform samplerBuffer positions;      // xyz [m], inverse mass [1/kg]
layout(binding = 3) uniform usamplerBuffer chunk_starts;  // of each object, and the end
layout(std430, binding = 2) readonly buffer Touches { uint object_touches[]; };
layout(std430, binding = 3) readonly buffer Chunks { Chunk chunks[]; };
layout(std430, binding = 4) buffer Sums { RigidSums rigid_sums[]; };
layout(std430, binding = 5) writeonly buffer Motions { RigidMotion motions[]; };
uniform uint element_count;

RigidSums add(RigidSums a, RigidSums b) {
    return RigidSums(a.arm + b.arm, a.way + b.way, a.moment + b.moment, a.square + b.square, a.product + b.product);
}

const RigidSums kNothing = RigidSums(vec4(0.0), vec4(0.0), vec4(0.0), vec4(0.0), vec4(0.0));

#ifdef OBJECTS
const float kLeastInertia = 1e-6;

mat3 cayley_turn(vec3 w) {
    mat3 cross_ = mat3(0.0, w.z, -w.y, -w.z, 0.0, w.x, w.y, -w.x, 0.0);
    return mat3(1.0) + 4.0 / (4.0 + dot(w, w)) * (cross_ + 0.5 * cross_ * cross_);
}

void main() {
    uint object = global_index();
    if (object >= element_count) return;
    uint first = texelFetch(chunk_starts, int(object)).x, end = texelFetch(chunk_starts, int(object) + 1).x;
    RigidSums sums = kNothing;
    for (uint c = first; c < end; ++c) sums = add(sums, rigid_sums[c]);
    if (sums.way.w > 0.0 || object_touches[object] != 0u) {
        motions[object].center.w = 0.0;
        return;
    }

    float mass = sums.arm.w;
    vec3 center = sums.arm.xyz / mass;  // from the origin
    vec3 shift = sums.way.xyz / mass;
    vec3 square = sums.square.xyz - mass * center * center;
    vec3 product = sums.product.xyz - mass * center.yzx * center.zxy;
    float trace = 2.0 * (square.x + square.y + square.z);
    NodeTerms turn;  // moment and inertia
    turn.force = sums.moment.xyz - mass * cross(center, shift);
    turn.diagonal = square.yzx + square.zxy + kLeastInertia * trace / 3.0;
    turn.beside = -product;
    mat3 matrix = cayley_turn(solve(turn));
    vec3 origin = texelFetch(positions, int(chunks[first].origin)).xyz;
    motions[object] = RigidMotion(vec4(origin + center, 1.0), vec4(shift, 0.0), vec4(matrix[0], 0.0),
                                  vec4(matrix[1], 0.0), vec4(matrix[2], 0.0));
}
#else
shared RigidSums parts[64];

void main() {
    uint c = group_index();
    if (c >= element_count) return;
    Chunk chunk = chunks[c];
    vec3 origin = texelFetch(positions, int(chunk.origin)).xyz;
    uint lane = gl_LocalInvocationID.x;
    RigidSums sums = kNothing;
    for (uint k = lane; k < chunk.count; k += 64u) {
        uint n = chunk.first + k;
        vec4 position = texelFetch(positions, int(n));
        if (position.w == 0.0) {
            sums.way.w += 1.0;
            continue;
        }
        vec3 r = position.xyz - origin, d = target_of(n) - position.xyz;
        float m = 1.0 / position.w;
        sums = add(sums, RigidSums(vec4(m * r, m), vec4(m * d, 0.0), vec4(m * cross(r, d), 0.0), vec4(m * r * r, 0.0),
                                   vec4(m * r.yzx * r.zxy, 0.0)));
    }
    parts[lane] = sums;
    barrier();
    if (lane != 0u) return;
    for (uint l = 1u; l < 64u; ++l) sums = add(sums, parts[l]);
    rigid_sums[c] = sums;
}
#endif
