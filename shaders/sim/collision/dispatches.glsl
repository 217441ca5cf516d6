// What the GPU has counted, as arguments of indirect dispatches (src/gpu/collision/collision_buffers.h).
#include "layouts/dispatch_slots.glsl"
#include "layouts/packing.glsl"
#include "sim/collision/bounds.glsl"
#include "sim/collision/make_dispatch.glsl"

#ifdef WRITES_DISPATCHES
layout(std430) buffer Dispatches { Dispatch dispatches[]; };
#else
layout(std430) readonly buffer Dispatches { Dispatch dispatches[]; };
#endif

#ifdef WRITES_DISPATCHES
// Allocates one more element in a list that a dispatch will process. Returns its index, or kNone if the list is full, which
// counts as a loss.
uint take_slot(uint work, uint capacity) {
    uint slot = atomicAdd(dispatches[work].count, 1u);
    if (slot >= capacity) {
        atomicAdd(dispatches[kLosses].count, 1u);
        return kNone;
    }
    if (slot % 64u == 0u) atomicAdd(dispatches[work].groups_x, 1u);
    return slot;
}

// Allocates `count` more elements in a list. Returns the first, or kNone if they do not fit, which counts as losses. The caller
// must then mark the remaining places, the last `left_over` ones, as empty.
uint take_slots(uint work, uint count, uint capacity, out uint left_over) {
    left_over = 0u;
    if (count == 0u) return kNone;
    // Nothing is added to a full list, so that its count does not overflow.
    uint first = max(dispatches[work].count, count) > capacity ? kNone : atomicAdd(dispatches[work].count, count);
    if (first > capacity - min(count, capacity)) {
        atomicAdd(dispatches[kLosses].count, count);
        left_over = capacity - min(first, capacity);
        return kNone;
    }
    atomicMax(dispatches[work].groups_x, (first + count + 63u) / 64u);
    return first;
}
#endif
