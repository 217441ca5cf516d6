// The tets of convex bodies that have lost distances where paths begin and end: a box round them by body, at the start. With ENDS those
// that have lost them where nodes end, and whether any box has grown by them. An invocation a tet.
// CPU twin: gelatin::cpu::KeptDistances. Parity: tests/gpu/implicit/find_pairs_test.cpp.
#include "include/global_index.glsl"
#include "layouts/contact_tuning.glsl"
#include "layouts/near_pair.glsl"
layout(local_size_x = 64) in;

uniform usamplerBuffer convex_tets;    // their corners
uniform usamplerBuffer tet_bodies;     // of each
uniform samplerBuffer tet_inverses;    // three texels: of the matrix of the edges from the first corner at the start [1/m]
uniform samplerBuffer rest_positions;  // at the start, xyz [m]
uniform samplerBuffer rotations;       // by object, three columns
uniform uint tet_count;
layout(std430) buffer LostBoxes { uint lost_boxes[]; };  // by object, 8: as in find_rotations.comp
#ifdef ENDS
uniform samplerBuffer ends;  // of nodes, xyz [m]
layout(std430) writeonly buffer Counts { PairCounts counts[]; };
#else
uniform samplerBuffer positions;  // xyz [m]
uniform samplerBuffer path_ends;  // xyz [m]
#endif

mat3 fetch_matrix(samplerBuffer columns, uint k) {
    int first = int(3u * k);
    return mat3(texelFetch(columns, first).xyz, texelFetch(columns, first + 1).xyz, texelFetch(columns, first + 2).xyz);
}

// Whether the eigenvalues of the symmetric part of R^T F are above what counts as kept: its leading minors are positive.
bool keeps(samplerBuffer at, uvec4 tet, mat3 inverse_, mat3 rotation) {
    vec3 a = texelFetch(at, int(tet.x)).xyz;
    mat3 f = mat3(texelFetch(at, int(tet.y)).xyz - a, texelFetch(at, int(tet.z)).xyz - a, texelFetch(at, int(tet.w)).xyz - a);
    mat3 m = transpose(rotation) * (f * inverse_);
    float xx = m[0].x - kNearly, yy = m[1].y - kNearly, zz = m[2].z - kNearly;
    float xy = 0.5 * (m[0].y + m[1].x), yz = 0.5 * (m[1].z + m[2].y), zx = 0.5 * (m[2].x + m[0].z);
    float second = xx * yy - xy * xy;
    float third = zz * second - (xx * yz * yz + yy * zx * zx - 2.0 * xy * yz * zx);
    return xx > 0.0 && second > 0.0 && third > 0.0;
}

// Bits that ascend as numbers do.
uint ordered(float value) {
    uint bits = floatBitsToUint(value);
    return bits ^ (uint(int(bits) >> 31) | 0x80000000u);
}

// @return whether the box has grown
bool add_to_box(uint body, vec3 x) {
    bool grew = false;
    for (uint axis = 0u; axis < 3u; ++axis) {
        uint bits = ordered(x[axis]);
        grew = atomicMin(lost_boxes[8u * body + axis], bits) > bits || grew;
        grew = atomicMax(lost_boxes[8u * body + 4u + axis], bits) < bits || grew;
    }
    return grew;
}

void main() {
    uint t = global_index();
    if (t >= tet_count) return;
    uvec4 tet = texelFetch(convex_tets, int(t));
    uint body = texelFetch(tet_bodies, int(t)).x;
    mat3 inverse_ = fetch_matrix(tet_inverses, t), rotation = fetch_matrix(rotations, body);
#ifdef ENDS
    if (keeps(ends, tet, inverse_, rotation)) return;
#else
    if (keeps(positions, tet, inverse_, rotation) && keeps(path_ends, tet, inverse_, rotation)) return;
#endif
    bool grew = false;
    for (int k = 0; k < 4; ++k) grew = add_to_box(body, texelFetch(rest_positions, int(tet[k])).xyz) || grew;
#ifdef ENDS
    if (grew) counts[0].has_lost = 1u;
#endif
}
