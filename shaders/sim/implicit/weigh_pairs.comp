// Which near pairs have a row, how stiff it is, and what is known of it from the part before; how many rows each node has. Each
// invocation makes every so many pairs.
// CPU twin: gelatin::cpu::ContactRows::make. Parity: tests/gpu/implicit/pair_rows_test.cpp.
#include "include/global_index.glsl"
#include "sim/implicit/near_pairs.glsl"
#include "sim/implicit/feasible_region.glsl"
#include "sim/implicit/pair_sides.glsl"
#include "sim/collision/nearest_points.glsl"
layout(local_size_x = 64) in;

uniform samplerBuffer rest_positions;    // at the start [m]
uniform samplerBuffer predicted;         // displacements [m]; w: 1 / h of contacts, 0 of held nodes [m/N]
uniform usamplerBuffer known_starts;     // of each node, and the end, in known_entries
uniform usamplerBuffer known_entries;    // 4 row + place of the node in it
uniform usamplerBuffer known_rows;       // RowMemory, two texels each
layout(std430) writeonly buffer PairWeights { PairWeight pair_weights[]; };
layout(std430) buffer EntryCounts { uint entry_counts[]; };  // of nodes

// Of the part before, the first that has the same sides; kNone: there is none.
uint find_memory(NearPair near) {
    uvec3 key = uvec3(near.first, near.is_edges != 0u ? near.second : near.other, near.is_edges);
    uint end = texelFetch(known_starts, int(near.node_0) + 1).x;
    for (uint e = texelFetch(known_starts, int(near.node_0)).x; e < end; ++e) {
        uint r = texelFetch(known_entries, int(e)).x / 4u;
        if (texelFetch(known_rows, 2 * int(r) + 1).yzw == key) return r;
    }
    return kNone;
}

// How near its sides are at the start [m].
float rest_gap(NearPair near) {
    vec3 x[4];
    uvec4 nodes = nodes_of(near);
    for (int k = 0; k < 4; ++k) x[k] = texelFetch(rest_positions, int(nodes[k])).xyz;
    return sqrt(near.is_edges != 0u ? edge_to_edge(x[0], x[1], x[2], x[3]).squared_distance
                                    : node_to_face(x[0], mat3(x[1], x[2], x[3])).squared_distance);
}

// How much both sides yield together [m/N]. Where held nodes bear most of a side, it is no stiffer than its free ones: these cannot
// bring apart what the others press together.
float compliance_of(NearPair near) {
    vec2 yields = vec2(0.0), free = vec2(0.0);
    uvec4 nodes = nodes_of(near);
    for (int k = 0; k < 4; ++k) {
        float w = near.weights[k], yield = texelFetch(predicted, int(nodes[k])).w;
        int side = side_of(near, k);
        if (yield > 0.0) free[side] += w;
        yields[side] += w * w * yield;
    }
    for (int side = 0; side < 2; ++side)
        if (free[side] > 0.0) yields[side] /= free[side] * free[side];
    return yields.x + yields.y;
}

float expected_gap(NearPair near) {
    vec4 weights = row_weights(near);
    uvec4 nodes = nodes_of(near);
    vec3 s = vec3(0.0);
    for (int k = 0; k < 4; ++k) s += weights[k] * texelFetch(predicted, int(nodes[k])).xyz;
    return near.normal.w + dot(near.normal.xyz, s);
}

PairWeight weigh(NearPair near) {
    PairWeight none = PairWeight(0.0, 0.0, 0.0, 0.0, kNone, 0u, 0u, 0u);
    float gap = near.normal.w;
    if (!(gap > 0.0)) return none;
    float weight = feasible_weight(near, near.normal.xyz), compliance = compliance_of(near);
    if (!(weight > 0.0) || !(compliance > 0.0)) return none;
    float stiffness = weight * touch_of(near).y * 4.0 / compliance, reach = near.reach, known_reach = 0.0;
    // Parts of a body that are near each other at rest do not press there.
    float there = expected_gap(near), rest_reach = near.object == near.other ? kOfRestGap * rest_gap(near) : reach;
    if (rest_reach < reach) {
        reach = rest_reach;
        if (min(gap, there) > kIdleGap * reach) return none;
    }
    uint memory = find_memory(near);
    if (memory != kNone)
        known_reach = max(uintBitsToFloat(texelFetch(known_rows, 2 * int(memory) + 1).x), min(reach, gap));
    return PairWeight(stiffness, reach, known_reach, there, memory, 0u, 0u, 0u);
}

void main() {
    uint p = global_index();
    if (p >= counts[0].pairs) return;
    NearPair near = fetch_pair(p);
    PairWeight own = weigh(near);
    pair_weights[p] = own;
    if (!(own.stiffness > 0.0)) return;
    uvec4 nodes = nodes_of(near);
    for (int k = 0; k < 4; ++k)
        if (near.weights[k] != 0.0) atomicAdd(entry_counts[nodes[k]], 1u);
}
