// Before gpu::FindProximities: nothing is found yet.
#define WRITES_DISPATCHES
#include "sim/collision/dispatches.glsl"
#include "include/global_index.glsl"
#include "layouts/proximity.glsl"
layout(local_size_x = 64) in;

layout(std430) writeonly buffer Found { ProximityCounts found; };
layout(std430) writeonly buffer Starts { uint starts[]; };  // counts of the queries, and a place for the end
uniform uint query_count;

void main() {
    uint index = global_index();
    if (index <= query_count) starts[index] = 0u;
    if (index != 0u) return;
    for (uint work = kNearObjects; work <= kEdgeTasks; ++work) dispatches[work] = Dispatch(0u, 1u, 1u, 0u);
    found = ProximityCounts(0u, 0u, 0x7F800000u, 0u);
}
