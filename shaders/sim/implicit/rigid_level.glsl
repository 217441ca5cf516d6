// The bodies of an island as rigid ones, coupled by their rows, for the work group of the island. Sums over rows go by chunks, pairs
// and bodies. What rows resist with, H, is at their points r of both sides: sums of H, G = -H [r], M = [r] G, and [r_0] G_1 for
// what couples them, where [r] v = r x v.
// CPU twin: gelatin::cpu::RigidSolve.
#include "sim/elasticity/node_terms.glsl"

const uint kMatrixSums = 18u, kPairSums = 21u;  // of a pair: columns of H, G_0, G_1, M_0, M_1, [r_0] G_1; then force, moments
uniform usamplerBuffer pairs;            // StepPair
uniform usamplerBuffer row_chunks;       // first row, end
uniform usamplerBuffer coupling_starts;  // of each object, and the end
uniform usamplerBuffer couplings;        // 2 pair + side
layout(std430) coherent buffer RowSums { vec4 row_sums[]; };    // by chunk of rows, kMatrixSums each
layout(std430) coherent buffer PairSums { vec4 pair_sums[]; };

// Of a kernel.
RowStiffness row_stiffness(uint r);
vec3 arm_at(uint r, uint side);                    // of a row [m]
uint body(uint k);                                 // the object of one of the island's bodies
void keep_inverse(uint k, BodyInverse inverse_);

// What invocations wrote is visible to all of the group.
void wait_for_group() {
    memoryBarrierBuffer();
    barrier();
}

mat3 matrix_of(vec3 d, vec3 b) { return mat3(d.x, b.z, b.y, b.z, d.y, b.x, b.y, b.x, d.z); }

// m [r]
mat3 times_cross(mat3 m, vec3 r) {
    return mat3(m[1] * r.z - m[2] * r.y, m[2] * r.x - m[0] * r.z, m[0] * r.y - m[1] * r.x);
}

// [r] m
mat3 cross_times(vec3 r, mat3 m) { return mat3(cross(r, m[0]), cross(r, m[1]), cross(r, m[2])); }

// @param count of sums of each chunk @param to where they go in those of a pair
void sum_by_pair(StepIsland island, uint count, uint to) {
    wait_for_group();
    uint end = (island.pair_end - island.first_pair) * count;
    for (uint i = gl_LocalInvocationID.x; i < end; i += kLanes) {
        uint p = island.first_pair + i / count, k = i % count;
        uvec4 pair = texelFetch(pairs, int(p));
        vec4 sum = vec4(0.0);
        for (uint c = pair.z; c < pair.w; ++c) sum += row_sums[c * kMatrixSums + k];
        pair_sums[p * kPairSums + to + k] = sum;
    }
    wait_for_group();
}

mat3 pair_matrix(uint p, uint number) {
    uint at = p * kPairSums + 3u * number;
    return mat3(pair_sums[at].xyz, pair_sums[at + 1u].xyz, pair_sums[at + 2u].xyz);
}

// What pairs exert on a body; w: what presses it [N].
BodyMotion sum_of_pairs(uint object) {
    BodyMotion sum = BodyMotion(vec4(0.0), vec4(0.0));
    uint end = texelFetch(coupling_starts, int(object) + 1).x;
    for (uint c = texelFetch(coupling_starts, int(object)).x; c < end; ++c) {
        uint coupling = texelFetch(couplings, int(c)).x, side = coupling % 2u;
        uint at = coupling / 2u * kPairSums + kMatrixSums;
        float sign = side == 0u ? -1.0 : 1.0;
        sum.displacement += vec4(vec3(sign), 1.0) * pair_sums[at];
        sum.rotation += sign * pair_sums[at + 1u + side];
    }
    return sum;
}

mat3 inverse_of(mat3 m) {
    NodeTerms terms = NodeTerms(vec3(0.0), vec3(m[0].x, m[1].y, m[2].z), vec3(m[2].y, m[2].x, m[1].x));
    return mat3(solve(terms, vec3(1.0, 0.0, 0.0)), solve(terms, vec3(0.0, 1.0, 0.0)), solve(terms, vec3(0.0, 0.0, 1.0)));
}

// E_b^-1, of the inertia and the pairs; 0 of a body that does not move as a rigid one.
BodyInverse find_inverse(uint object) {
    vec4 diagonal = texelFetch(bodies, 5 * int(object) + 3);
    vec4 no = vec4(0.0);
    if (!(diagonal.w > 0.0)) return BodyInverse(no, no, no, no, no, no, no, no, no);
    mat3 a = mat3(diagonal.w), b = mat3(0.0), c = matrix_of(diagonal.xyz, texelFetch(bodies, 5 * int(object) + 4).xyz);
    uint end = texelFetch(coupling_starts, int(object) + 1).x;
    for (uint k = texelFetch(coupling_starts, int(object)).x; k < end; ++k) {
        uint coupling = texelFetch(couplings, int(k)).x, side = coupling % 2u;
        a += pair_matrix(coupling / 2u, 0u);
        b += pair_matrix(coupling / 2u, 1u + side);
        c += pair_matrix(coupling / 2u, 3u + side);
    }
    mat3 inverse_a = inverse_of(a), x = inverse_a * b, i = inverse_of(c - transpose(b) * x);
    return BodyInverse(vec4(inverse_a[0], 0.0), vec4(inverse_a[1], 0.0), vec4(inverse_a[2], 0.0), vec4(x[0], 0.0),
                       vec4(x[1], 0.0), vec4(x[2], 0.0), vec4(i[0], 0.0), vec4(i[1], 0.0), vec4(i[2], 0.0));
}

// By the rows' tangents: sums of pairs, and inverses of bodies.
void find_matrix(StepIsland island) {
    for (uint c = island.first_row_chunk + gl_LocalInvocationID.x; c < island.row_chunk_end; c += kLanes) {
        mat3 sums[6];
        for (int k = 0; k < 6; ++k) sums[k] = mat3(0.0);
        uvec2 range = texelFetch(row_chunks, int(c)).xy;
        for (uint r = range.x; r < range.y; ++r) {
            RowStiffness k = row_stiffness(r);
            mat3 h = matrix_of(k.diagonal, k.beside);
            vec3 first = arm_at(r, 0u), second = arm_at(r, 1u);
            mat3 by_first = times_cross(-h, first), by_second = times_cross(-h, second);
            sums[0] += h;
            sums[1] += by_first;
            sums[2] += by_second;
            sums[3] += cross_times(first, by_first);
            sums[4] += cross_times(second, by_second);
            sums[5] += cross_times(first, by_second);
        }
        for (uint k = 0u; k < kMatrixSums; ++k) row_sums[c * kMatrixSums + k] = vec4(sums[k / 3u][k % 3u], 0.0);
    }
    sum_by_pair(island, kMatrixSums, 0u);
    for (uint k = island.first_body + gl_LocalInvocationID.x; k < island.body_end; k += kLanes)
        keep_inverse(k, find_inverse(body(k)));
}
