// Running sums of how many each query has found: where what it found begins. Three dispatches: sums within each work group
// of queries; with GROUPS one work group sums up the groups' sums; with STARTS both are added up.
// CPU twin: gelatin::cpu::FindProximities. Parity: tests/gpu/proximity/find_proximities_test.cpp.
#include "layouts/packing.glsl"
#include "include/global_index.glsl"
#include "layouts/proximity.glsl"
layout(local_size_x = 256) in;

layout(std430) buffer Found { ProximityCounts found; };
layout(std430) buffer GroupSums { uint group_sums[]; };
layout(std430) buffer Starts { uint starts[]; };  // counts of the queries, and a place for the end
uniform uint query_count;
uniform uint node_count;  // queries that are nodes

const uint kLaneQueries = kQueriesAGroup / 256u;

shared uint parts[256];

// The sum of the lanes' values before this one.
uint sum_before(uint value) {
    uint lane = gl_LocalInvocationID.x;
    parts[lane] = value;
    barrier();
    for (uint reach = 1u; reach < 256u; reach *= 2u) {
        uint other = lane >= reach ? parts[lane - reach] : 0u;
        barrier();
        parts[lane] += other;
        barrier();
    }
    return parts[lane] - value;
}

void main() {
#if defined(GROUPS)
    uint lane = gl_LocalInvocationID.x;
    uint group_count = (query_count + kQueriesAGroup - 1u) / kQueriesAGroup;
    uint share = (group_count + 255u) / 256u;
    uint first = min(lane * share, group_count);
    uint last = min(first + share, group_count);
    uint sum = 0u;
    for (uint group = first; group < last; ++group) sum += group_sums[group];
    uint at = sum_before(sum);
    for (uint group = first; group < last; ++group) {
        uint next = at + group_sums[group];
        group_sums[group] = at;
        at = next;
    }
    if (lane == 255u) starts[query_count] = at;
#elif defined(STARTS)
    uint query = global_index();
    if (query > query_count) return;
    uint at = starts[query];
    if (query < query_count) at += group_sums[query / kQueriesAGroup];
    starts[query] = at;
    if (query == node_count) found.node_face = at;
    if (query == query_count) found.all = at;
#else
    if (kQueriesAGroup * group_index() >= query_count) return;  // the whole group leaves, so no one waits at the barrier
    uint first = min(kLaneQueries * global_index(), query_count);
    uint last = min(first + kLaneQueries, query_count);
    uint sum = 0u;
    for (uint query = first; query < last; ++query) sum += starts[query];
    uint at = sum_before(sum);
    if (gl_LocalInvocationID.x == 255u) group_sums[group_index()] = at + sum;
    for (uint query = first; query < last; ++query) {
        uint next = at + starts[query];
        starts[query] = at;
        at = next;
    }
#endif
}
