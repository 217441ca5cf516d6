// The motion of each body as a rigid one that takes it to where the objective is least. Without OBJECTS: sums over a
// chunk's nodes, four chunks a work group; with it: the motion, one invocation an object.
// CPU twin: gelatin::cpu::RigidStep. Parity: tests/gpu/descent/block_descent_test.cpp.
#include "layouts/rigid_sums.glsl"
#include "include/global_index.glsl"
#include "sim/descent/descent_step.glsl"
#include "sim/descent/rigid_sums.glsl"
#include "layouts/chunk.glsl"
#include "layouts/descent.glsl"
layout(local_size_x = 64) in;

uniform samplerBuffer positions;      // xyz [m], inverse mass [1/kg]
uniform usamplerBuffer chunk_starts;  // of each object, and the end
layout(std430) readonly buffer ObjectContacts { uint object_contacts[]; };
layout(std430) readonly buffer Chunks { Chunk chunks[]; };
#ifdef OBJECTS
layout(std430) readonly buffer Sums { RigidSums rigid_sums[]; };
#else
layout(std430) writeonly buffer Sums { dvec4 sum_members[]; };  // of RigidSums
#endif
layout(std430) writeonly buffer Motions { RigidMotion motions[]; };
#if COLLIDER_KINDS != 0
layout(std430) readonly buffer Contacts { ColliderContact contacts[]; };  // of nodes
#endif
uniform uint element_count;

#ifdef OBJECTS
uniform uint is_last;  // bodies in contact with a collider do not move then: the last sweep has left their nodes outside

// The rotation about w by 2 atan(|w| / 2), less the identity.
mat3 cayley_rotation(vec3 w) {
    mat3 cross_ = mat3(0.0, w.z, -w.y, -w.z, 0.0, w.x, w.y, -w.x, 0.0);
    return 4.0 / (4.0 + dot(w, w)) * (cross_ + 0.5 * cross_ * cross_);
}

void main() {
    uint object = global_index();
    if (object >= element_count) return;
    uint first = texelFetch(chunk_starts, int(object)).x, end = texelFetch(chunk_starts, int(object) + 1).x;
    RigidSums sums = kNothing;
    for (uint c = first; c < end; ++c) sums = add(sums, rigid_sums[c]);
    bool is_held = sums.square.w > 0.0;
    if (is_held || (is_last != 0u && object_contacts[object] != 0u)) {
        motions[object].center.w = 0.0;
        return;
    }
    dvec3 translation, rotation;
    solve_rigid_step(sums, translation, rotation);
    mat3 matrix = cayley_rotation(vec3(rotation));
    // A rotation about the centre of mass does not move it, however large.
    dvec3 center = sums.arm.xyz / sums.arm.w;
    vec3 origin = texelFetch(positions, int(chunks[first].origin)).xyz;
    motions[object] = RigidMotion(vec4(origin + vec3(center), 1.0), vec4(vec3(translation + cross(rotation, center)), 0.0),
                                  vec4(matrix[0], 0.0), vec4(matrix[1], 0.0), vec4(matrix[2], 0.0));
}
#else
// The sums of each lane, member by member of RigidSums.
const uint kMembers = 16u;
shared dvec4 parts[kMembers * 64u];

void share(uint lane, RigidSums sums) {
    parts[lane] = sums.arm;
    parts[64u + lane] = sums.square;
    parts[128u + lane] = sums.product;
    parts[192u + lane] = sums.force;
    parts[256u + lane] = sums.moment;
    parts[320u + lane] = sums.translations;
    parts[384u + lane] = sums.translation_pairs;
    parts[448u + lane] = sums.rotations;
    parts[512u + lane] = sums.rotation_pairs;
    parts[576u + lane] = sums.mixed_x;
    parts[640u + lane] = sums.mixed_y;
    parts[704u + lane] = sums.mixed_z;
    parts[768u + lane] = sums.sliding_arm;
    parts[832u + lane] = sums.sliding_square;
    parts[896u + lane] = sums.sliding_product;
    parts[960u + lane] = sums.sliding_moment;
}

// Few lanes a chunk: what a lane has to share costs more than a node.
const uint kLanes = kLanesAChunk;
const uint kChunks = 64u / kLanes;  // a work group

RigidSums sum_nodes(Chunk chunk, uint lane) {
    vec3 origin = texelFetch(positions, int(chunk.origin)).xyz;
    RigidSums sums = kNothing;
    for (uint k = lane; k < chunk.count; k += kLanes) {
        uint n = chunk.first + k;
        vec4 position = texelFetch(positions, int(n)), target = texelFetch(targets, int(n));
        if (position.w == 0.0) sums.square.w += 1.0;  // and target.w is 0
        double stiffness = double(target.w);
        add_node(dvec3(position.xyz - origin), stiffness, stiffness * dvec3(target.xyz - position.xyz), sums);
    }
#if COLLIDER_KINDS != 0
    // A loop of its own, which bodies without contacts do not enter.
    uint contact_count = object_contacts[chunk.object] != 0u ? chunk.count : 0u;
    for (uint k = lane; k < contact_count; k += kLanes) {
        uint n = chunk.first + k;
        ColliderContact contact = contacts[n];
        vec4 position = texelFetch(positions, int(n));
        if (position.w == 0.0 || contact.force.w == 0.0) continue;
        dvec3 force = dvec3(contact.force.xyz), normal = dvec3(contact.normal.xyz);
        double pressing = dot(force, normal);
        add_contact(dvec3(position.xyz - origin), normal, pressing, force - pressing * normal, double(contact.force.w),
                  double(contact.normal.w), sums);
    }
#endif
    return sums;
}

void main() {
    uint lane = gl_LocalInvocationID.x, first = kChunks * group_index(), c = first + lane / kLanes;
    share(lane, c < element_count ? sum_nodes(chunks[c], lane % kLanes) : kNothing);
    barrier();
    uint k = lane / kMembers, member = lane % kMembers;  // as many members as lanes a chunk
    c = first + k;
    if (c >= element_count) return;
    uint from = 64u * member + kLanes * k;
    dvec4 sum = parts[from];
    for (uint l = 1u; l < kLanes; ++l) sum += parts[from + l];
    sum_members[kMembers * c + member] = sum;
}
#endif
