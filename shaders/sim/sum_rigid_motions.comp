// The motion of each body as a rigid one that takes it to where the objective is least. Without OBJECTS: sums over a
// chunk's nodes, one work group a chunk; with it: the motion, one invocation an object.
// CPU twin: gelatin::cpu::RigidStep. Parity: tests/gpu/block_descent_test.cpp.
#include "include/global_index.glsl"
#include "include/descent_step.glsl"
#include "include/rigid_sums.glsl"
#include "layouts/chunk.glsl"
#include "layouts/descent.glsl"
layout(local_size_x = 64) in;

layout(binding = 0) uniform samplerBuffer positions;      // xyz [m], inverse mass [1/kg]
layout(binding = 3) uniform usamplerBuffer chunk_starts;  // of each object, and the end
layout(std430, binding = 2) readonly buffer ObjectTouches { uint object_touches[]; };
layout(std430, binding = 3) readonly buffer Chunks { Chunk chunks[]; };
layout(std430, binding = 4) buffer Sums { RigidSums rigid_sums[]; };
layout(std430, binding = 5) writeonly buffer Motions { RigidMotion motions[]; };
#if COLLIDER_KINDS != 0
layout(std430, binding = 6) readonly buffer Touches { Touch touches[]; };  // of nodes
#endif
uniform uint element_count;

#ifdef OBJECTS
uniform uint is_last;  // the last sweep has left nodes outside colliders: bodies that touch one do not move after it

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
    bool is_held = sums.square.w > 0.0;
    if (is_held || (is_last != 0u && object_touches[object] != 0u)) {
        motions[object].center.w = 0.0;
        return;
    }
    dvec3 shift, turn;
    solve_rigid_step(sums, shift, turn);
    mat3 matrix = cayley_turn(vec3(turn));
    // A turn about the centre of mass does not move it, however large.
    dvec3 center = sums.arm.xyz / sums.arm.w;
    vec3 origin = texelFetch(positions, int(chunks[first].origin)).xyz;
    motions[object] = RigidMotion(vec4(origin + vec3(center), 1.0), vec4(vec3(shift + cross(turn, center)), 0.0),
                                  vec4(matrix[0], 0.0), vec4(matrix[1], 0.0), vec4(matrix[2], 0.0));
}
#else
shared RigidSums parts[64];

void main() {
    uint c = group_index();
    if (c >= element_count) return;
    Chunk chunk = chunks[c];
    vec3 origin = texelFetch(positions, int(chunk.origin)).xyz;
    double inertia = 1.0 / (double(time_step) * double(time_step));
    uint lane = gl_LocalInvocationID.x;
    RigidSums sums = kNothing;
    for (uint k = lane; k < chunk.count; k += 64u) {
        uint n = chunk.first + k;
        vec4 position = texelFetch(positions, int(n));
        if (position.w == 0.0) {
            sums.square.w += 1.0;
            continue;
        }
        dvec3 r = dvec3(position.xyz - origin);
        double stiffness = inertia / double(position.w);
        add_node(r, stiffness, stiffness * dvec3(target_of(n) - position.xyz), sums);
#ifdef PULLED
        vec4 pull = pull_terms(n, position.xyz, texelFetch(start_positions, int(n)).xyz, time_step);
        add_node(r, double(pull.w), dvec3(pull.xyz), sums);
#endif
#if COLLIDER_KINDS != 0
        Touch touch = touches[n];
        if (object_touches[chunk.object] == 0u || touch.force.w == 0.0) continue;
        add_node(r, double(touch.normal.w), dvec3(touch.force.xyz), sums);
        add_along(r, dvec3(touch.normal.xyz), double(touch.force.w) - double(touch.normal.w), sums);
#endif
    }
    parts[lane] = sums;
    barrier();
    if (lane != 0u) return;
    for (uint l = 1u; l < 64u; ++l) sums = add(sums, parts[l]);
    rigid_sums[c] = sums;
}
#endif
