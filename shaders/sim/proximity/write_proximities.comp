// Writes what a task has found behind what the tasks before it have found for the same node, or with EDGES edge: in the
// order of the faces or edges. CPU twin: gelatin::cpu::FindProximities. Parity: tests/gpu/proximity/find_proximities_test.cpp.
#include "sim/proximity/proximity_task.glsl"
layout(local_size_x = 64) in;

layout(std430) writeonly buffer Proximities { Proximity proximities[]; };
layout(std430) buffer Found { ProximityCounts found; };
layout(std430) readonly buffer Hits { uvec4 hits[]; };
layout(std430) readonly buffer Starts { uint starts[]; };  // of each query: nodes, then edges
uniform uint proximity_capacity;
uniform uint first_query;

uint count_hits(uint t) {
    ivec4 count = bitCount(hits[t]);
    return uint(count.x + count.y + count.z + count.w);
}

Proximity make_proximity(uint first, uint second, Nearest nearest) {
    float distance = sqrt(nearest.points.squared_distance);
#ifdef EDGES
    float s = nearest.points.fraction, t = nearest.points.other_fraction;
    vec3 apart = nearest.points.apart;
    if (first < second) return Proximity(first, second, distance, 0u, vec4(apart, 0.0), vec4(1.0 - s, s, 1.0 - t, t));
    return Proximity(first, second, distance, 0u, vec4(-apart, 0.0), vec4(1.0 - t, t, 1.0 - s, s));
#else
    return Proximity(first, second, distance, 0u, vec4(nearest.points.apart, 0.0), vec4(nearest.points.weights, 0.0));
#endif
}

void main() {
    uint t = global_index();
    if (t >= min(dispatches[kTasks].count, task_capacity) || task_leaves[t] == kNone) return;
    uvec4 left = hits[t];
    if (!any_bit(left)) return;
    Task task = fetch_task(t);
    uint place = starts[first_query + task.place];
    for (uint before = t - task.chunk; before < t; ++before) place += count_hits(before);
#ifdef EDGES
    uint query = task.place;
#else
    uint query = texelFetch(surface_nodes, int(task.place)).x;
#endif
    float least = kInfinity;
    while (any_bit(left)) {
        uint bit = take_bit(left);
        uint second = first_of_leaf(task, bit / 16u) + bit % 16u;
        Proximity proximity = make_proximity(query, second, nearest_to(query, second));
        least = min(least, proximity.distance);
        if (place < proximity_capacity) proximities[place] = proximity;
        ++place;
    }
    atomicMin(found.nearest, floatBitsToUint(least));  // bits of what is not negative ascend like their values
}
